# The headers' plain comments as Doxygen reads them: the filter of docs/Doxyfile.in.
1s|^// clang-format off|/// @file|
1s|^// |/// @file\n/// |
/clang-format o(n|ff)/d
/^(inline namespace GAULT_ISA \{|\} \/\/ namespace GAULT_ISA)$/d
s|^\} // namespace.*|}|

# gault.h: its rules are the first page, its parts are groups, and what is said of a struct behind its brace is said of it.
s|^/\* gault\.h - (.*)|/** @file */\n/** @mainpage The contract between Gault and its plugins\n * gault.h: \1|
s/^( \* +)\[(main|worker|any)\]/\1- [\2]/
s|^#define GAULT_ABI_MAJOR|/** @defgroup basics basics\n * @{ */\n&|
s|^/\* -+ module and components|/* ---- components|
s|^/\* -+ (kind: )?([a-z]+) -+|/** @} */\n/** @defgroup \2 \2\n * @{\n *|
$s|^#endif$|/** @} */\n&|
s|^typedef struct (\w+) \{ +/\* (.*)|/** @struct \1\n * \2\ntypedef struct \1 {|
s|^enum \{ /\* (.*\*/)$|/** \1\nenum {|
/^typedef uint32_t/N
s|^(typedef uint32_t (\w+);)\nenum|/** One of the following. */\n\1\n/** What a #\2 may be. */\nenum|
s|^enum \{$|/** Constants. */\n&|

# A comment of its own: of what follows. Four blanks make it code.
s|^( *)/\* |\1/** |
s|^//   |///     |
s|^( *)//( .*)?$|\1///\2|
/^ *\/\/\//b

# One comment behind several fields stands with the last, to which the others refer.
s/^.*$/\n&/
:several
s!(\n +)([a-z_0-9 ]*[a-z_0-9]) ([*]*\w+(\[\w+\])?), ([^\n;(]*[ *])?(\w+)(\[?\w*\]?; +/[/*][^\n]*)!\1\2 \3; /**< see #\6 */\1\2 \5\6\7!
tseveral
s/^\n//

# A comment behind something.
s!(; +| +GAULT_[^(]*, +|^#define .*[^ ] +)/\* !\1/**< @brief !
s|([^ /*] +)/\* |\1/**< |
s|([;,{})] +)// |\1///< @brief |

// Every defect that a plugin file can have is refused with one line that names the file and both sides: what
// the file has or wants, and what the host expects or offers.
#include "core/registry/declared.hpp"
#include "core/registry/registry.hpp"

#include <gtest/gtest.h>
#include <set>
#include <xmmintrin.h>

using namespace gault::core;
namespace fs = std::filesystem;

namespace {

const fs::path contract_dir = CONTRACT_DIR;

fs::path plugin(const std::string& defect) {
    return contract_dir / defect / (defect + ".so");
}

std::string refusal(const std::vector<fs::path>& search_path) {
    try {
        Registry registry(search_path);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

struct Defect {
    std::string name, text;
};
void PrintTo(const Defect& defect, std::ostream* stream) {
    *stream << defect.name;
}

const Defect defects[] = {
    {"no_entry", "has no entry symbol; the host expects a plugin to export gault_module_v1 (define it with "
                 "GAULT_EXPORT)"},
    {"entry_is_code", "exports gault_module_v1 as code; the host expects constant data, a gault_module"},
    {"short_entry", "gault_module_v1 has 4 bytes; the host expects a gault_module of at least 24"},
    {"wrong_major", "was built for ABI major 2 (gault_module_v2); this host offers 1 (gault_module_v1)"},
    {"contradicts_its_major", "gault_module_v1 says ABI major 2; this host offers 1"},
    {"wrong_magic", "gault_module_v1 begins with 0x12345678; the host expects 0x31544c47"},
    {"four_byte_reals", "gault_module_v1 says 4-byte reals; the host has 8-byte ones"},
    {"four_byte_pointers", "gault_module_v1 says 4-byte pointers; the host has 8-byte ones"},
    {"oversized_module", "gault_module_v1 says 4096 bytes and has 72; the host expects at least 72"},
    {"undersized_module", "gault_module_v1 says 32 bytes and has 72; the host expects at least 72"},
    {"undefined_symbol",
     "wants the symbol 'missing_function', which neither it nor a library it links to defines; link what "
     "defines it (the linker option -Wl,-z,defs finds this while building)"},
    {"undefined_cpp_symbol",
     "wants the symbol 'fits::curve(double, int)' (_ZN4fits5curveEdi), which neither it"},
    {"missing_library", "wants the library 'libcontract_missing.so', which is not found on this system"},
    {"changes_rounding",
     "changes the floating-point mode of the whole process (rounding); the host expects it unchanged"},
    {"fast_math", "changes the floating-point mode of the whole process (flush to zero, denormals are zero); "
                  "the host expects "
                  "it unchanged: build and link without -ffast-math"},
    {"unnamed_module", "the module has no name"},
    {"null_license",
     "the module has NULL as its author, license or built_with; the host expects texts, which may be empty"},
    {"null_components", "the module has no components"},
    {"no_components", "the module has no components"},
    {"component_twice", "material 'tiny' is declared twice"},
    {"unknown_kind", "a component is of the unknown kind 9; the host knows 1 to 4"},
    {"undersized_component", "a component has 16 bytes; the host expects at least 80"},
    {"unnamed_component", "a material has no name"},
    {"shouting_component", "a material has the name 'Tiny Soil'; allowed: a-z, then a-z, 0-9 and _"},
    {"unversioned_component", "material 'tiny' has no version"},
    {"undocumented_component", "material 'tiny' has no doc"},
    {"null_reference",
     "material 'tiny' has NULL as its reference; the host expects a text, which may be empty"},
    {"null_parameters",
     "material 'tiny' has NULL as its parameters; the host expects a list that ends with NULL"},
    {"null_api", "material 'tiny' has NULL as its api"},
    {"null_create", "material 'tiny' has NULL as its create function"},
    {"null_destroy", "material 'tiny' has NULL as its destroy function"},
    {"undersized_api", "material 'tiny' has an api of 8 bytes; the host expects at least 56"},
    {"null_update", "material 'tiny' has NULL as its update function"},
    {"null_states", "material 'tiny' has NULL as its 1 states"},
    {"undersized_program_api", "program 'tiny' has an api of 32 bytes; the host expects at least 40"},
    {"too_many_states", "material 'tiny' has more than 4096 state components"},
    {"input_twice", "material 'tiny' asks for the input 'density' twice"},
    {"state_out_of_bounds", "material 'tiny': state 'age' begins at -1, outside its bounds 0 and inf"},
    {"state_of_unknown_shape", "material 'tiny': state 'age' has the shape 9; the host knows 1, 3 and 6"},
    {"state_without_unit", "material 'tiny': state 'age' has no unit; a pure number has the unit \"1\""},
    {"boundary_without_functions", "boundary 'tiny' has neither a constrain nor a load function"},
    {"module_with_reserved_bits", "gault_module_v1 has 0x1 in a field that is reserved; the host expects 0"},
    {"material_with_unknown_flags", "material 'tiny' has the flags 0x10; the host knows 0xf here"},
    {"state_with_reserved_bits",
     "material 'tiny': state 'age' has 0x1 in a field that is reserved; the host expects 0"},
    {"boundary_with_unknown_flags", "boundary 'tiny' has the flags 0x20; the host knows 0x7 here"},
    {"null_controls", "boundary 'tiny' has NULL as its 2 controls"},
    {"program_without_advance", "program 'tiny' has NULL as its advance function"},
    {"program_without_signals", "program 'tiny' has neither signals nor instance_signals"},
    {"record_without_unit", "program 'tiny': record 'depth' has no unit; a pure number has the unit \"1\""},
    {"signal_with_unknown_flags",
     "program 'tiny': control 'speed' has the flags 0x5; the host knows 0x1 here"},
    {"optional_record", "program 'tiny': record 'depth' has the flags 0x1; the host knows 0x0 here"},
    {"signal_with_reserved_bits",
     "boundary 'tiny': control 'pressure' has 0x1 in a field that is reserved; the host expects 0"},
    {"observer_without_evaluate", "observer 'tiny' has NULL as its evaluate function"},
    {"parameter_twice", "material 'tiny': parameter 'stiffness' is declared twice"},
    {"undersized_parameter", "material 'tiny' has a parameter of 4 bytes; the host expects at least 112"},
    {"parameter_with_unknown_flags",
     "material 'tiny': parameter 'stiffness' has the flags 0x10; the host knows 0xf here"},
    {"misnamed_parameter",
     "material 'tiny': a parameter has the name '2k'; allowed: a-z, then a-z, 0-9 and _"},
    {"unnamed_parameter", "material 'tiny': a parameter has no name"},
    {"undocumented_parameter", "material 'tiny': parameter 'stiffness' has no doc"},
    {"parameter_without_unit",
     "material 'tiny': parameter 'stiffness' has no unit; a pure number has the unit \"1\""},
    {"parameter_without_symbol", "material 'tiny': parameter 'stiffness' has NULL as its symbol"},
    {"unknown_type", "material 'tiny': parameter 'stiffness' has the unknown type 17; the host knows 1 to 8"},
    {"min_above_max", "material 'tiny': parameter 'stiffness' has min 2 above max 1"},
    {"bound_not_a_number", "material 'tiny': parameter 'stiffness' has a bound that is not a number"},
    {"empty_open_interval",
     "material 'tiny': parameter 'stiffness' allows no value: its open bounds are both 1"},
    {"fallback_out_of_bounds",
     "material 'tiny': parameter 'stiffness' has the default 0, outside its bounds 0 and inf"},
    {"fractional_integer",
     "material 'tiny': parameter 'stiffness' has the default 1.5, which is no whole number"},
    {"infinite_integer",
     "material 'tiny': parameter 'stiffness' has the default inf, which is no whole number"},
    {"half_true", "material 'tiny': parameter 'stiffness' has the default 0.5; a boolean is 0 or 1"},
    {"required_and_optional", "material 'tiny': parameter 'stiffness' is both REQUIRED and OPTIONAL"},
    {"text_without_default",
     "material 'tiny': parameter 'stiffness' has no default (its type has none) and says neither"},
    {"choice_without_choices", "material 'tiny': parameter 'stiffness' is a choice without choices"},
    {"choice_out_of_range",
     "material 'tiny': parameter 'stiffness' has the default 2, an index into 2 choices"},
    {"choice_twice", "material 'tiny': parameter 'stiffness' offers 'dry' twice"},
    {"table_without_x_unit", "material 'tiny': parameter 'stiffness' is a table without an x_unit"},
    {"records_without_kinds", "material 'tiny': parameter 'stiffness' is a list of records without kinds"},
    {"impossible_count", "material 'tiny': parameter 'stiffness' wants 5 to 2 entries"},
    {"endless_records", "nests records more than 4 deep"},
};

// Named, and refused in tests of their own: the defect needs a second file, or shows when the component is
// created.
const std::set<std::string> elsewhere{"entry_from_dependency", "unique_one",      "unique_other",
                                      "first_of_two",          "second_of_two",   "changes_mode_when_created",
                                      "instance_states",       "instance_signals"};

Parameters one_parameter() {
    Parameters parameters;
    parameters.values.push_back({});
    parameters.locations.push_back({});
    return parameters;
}

class DefectiveFile : public testing::TestWithParam<Defect> {};

} // namespace

TEST_P(DefectiveFile, IsRefusedInOneLine) {
    const std::string found = refusal({plugin(GetParam().name).parent_path()});
    EXPECT_TRUE(found.starts_with(plugin(GetParam().name).string() + ": ")) << found;
    EXPECT_NE(found.find(GetParam().text), std::string::npos) << found << "\n(expected) " << GetParam().text;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
}

INSTANTIATE_TEST_SUITE_P(, DefectiveFile, testing::ValuesIn(defects),
                         [](const auto& defect) { return defect.param.name; });

TEST(DefectivePlugins, AreAllTested) {
    std::set<std::string> tested = elsewhere;
    for (const Defect& defect : defects)
        tested.insert(defect.name);
    for (const fs::directory_entry& source :
         fs::directory_iterator(GAULT_SOURCE_DIR "/tests/contract/defective"))
        EXPECT_TRUE(source.path().extension() == ".h" || tested.contains(source.path().stem()))
            << source.path();
}

TEST(DefectivePlugin, WithTheEntryOfADependencyIsToldWhichOne) {
    const std::string found = refusal({plugin("entry_from_dependency")});
    const fs::path dependency = contract_dir / "entry_from_dependency/lib/libcontract_dependency.so";
    EXPECT_EQ(
        found,
        plugin("entry_from_dependency").string() +
            ": has no entry symbol gault_module_v1 of its own; the one it sees belongs to the library " +
            dependency.string() + " that it links to; the host expects it in the file itself");
}

TEST(DefectivePlugin, WithAnEntryThatIsUniqueInTheProcessIsToldWhereItLeads) {
    const std::string found = refusal({plugin("unique_one"), plugin("unique_other")});
    EXPECT_EQ(
        found,
        plugin("unique_other").string() + ": has an entry symbol gault_module_v1 that leads to " +
            plugin("unique_one").string() +
            "; the host expects it in the file itself: compile with -fno-gnu-unique and -fvisibility=hidden");
}

TEST(DefectivePlugin, WithAComponentOfAnotherFileIsToldWhichFile) {
    const std::string found = refusal({plugin("first_of_two"), plugin("second_of_two")});
    EXPECT_EQ(found, plugin("second_of_two").string() + ": provides the material 'doubled', which " +
                         plugin("first_of_two").string() +
                         " provides already; take one of the two files away");
}

TEST(DefectivePlugin, LeavesTheFloatingPointModeAsItWas) {
    const unsigned before = _mm_getcsr();
    refusal({plugin("fast_math")});
    refusal({plugin("changes_rounding")});
    EXPECT_EQ(_mm_getcsr() & 0xFFC0, before & 0xFFC0);
}

TEST(DefectivePlugin, IsRefusedAgainAlthoughItsConstructorsHaveRun) {
    const std::string once = refusal({plugin("fast_math")});
    EXPECT_EQ(refusal({plugin("fast_math")}), once);
}

TEST(DefectivePlugin, ThatChangesTheFloatingPointModeWhenCreatedIsRefusedThen) {
    const Registry registry({plugin("changes_mode_when_created")});
    const unsigned before = _mm_getcsr();
    try {
        const Instance instance(registry.find(GAULT_MATERIAL, "tiny"), one_parameter());
        ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
        EXPECT_EQ(e.what(), plugin("changes_mode_when_created").string() +
                                ": material 'tiny' changes the floating-point mode (flush to zero) when it "
                                "is created; the host "
                                "expects it unchanged");
    }
    EXPECT_EQ(_mm_getcsr() & 0xFFC0, before & 0xFFC0);
}

// ---- what an instance declares --------------------------------------------------------------------------

namespace {

std::string refusal_of_states(const Registry& registry, const std::string& name) {
    const Instance instance(registry.find(GAULT_MATERIAL, name), one_parameter());
    try {
        material_states(instance);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

std::string refusal_of_signals(const Registry& registry, const std::string& name) {
    const Instance instance(registry.find(GAULT_PROGRAM, name), one_parameter());
    try {
        program_signals(instance);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

} // namespace

TEST(InstanceStates, AreCheckedAsStaticOnesAre) {
    const Registry registry({plugin("instance_states")});
    const auto expect = [&](const std::string& name, const std::string& text) {
        EXPECT_EQ(refusal_of_states(registry, name),
                  plugin("instance_states").string() + ": material '" + name + "': instance_states" + text);
    };
    expect("null", " has NULL as its 3 states");
    expect("shapeless", ": state 'age' has the shape 2; the host knows 1, 3 and 6");
    expect("twice", ": state 'age' is declared twice");
    expect("nameless", ": a state has no name");
    expect("countless", " has more than 4096 state components");
}

TEST(InstanceSignals, AreCheckedAsStaticOnesAre) {
    const Registry registry({plugin("instance_signals")});
    const auto expect = [&](const std::string& name, const std::string& text) {
        EXPECT_EQ(refusal_of_signals(registry, name),
                  plugin("instance_signals").string() + ": program '" + name + "': instance_signals" + text);
    };
    expect("null", " answers NULL; the host expects signals");
    expect("brief", " has signals of 16 bytes; the host expects at least 56");
    expect("listless", " has NULL as its 2 measures");
    expect("twice", ": record 'depth' is declared twice");
    expect("misnamed", ": a control has the name 'Wall speed'; allowed: a-z, then a-z, 0-9 and _");
    expect("unitless", ": memory 'travel' has no unit; a pure number has the unit \"1\"");
}

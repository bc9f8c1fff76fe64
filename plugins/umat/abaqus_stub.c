/* What UMATs call of Abaqus itself: compile it together with the UMAT. XIT leaves the UMAT, and the run ends
 * with the point named; STDB_ABQERR writes its message to stderr, and does the same where LOP is -3. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* Set by the plugin; does not return. */
__attribute__((visibility("default"))) void (*gault_umat_xit)(void);

void xit_(void);
void xit_(void) {
    if (gault_umat_xit) gault_umat_xit();
    abort();
}

/* %I, %R and %S in the text stand for the next integer, real and word of eight characters. */
void stdb_abqerr_(const int* lop, const char* text, const int* integers, const double* reals,
                  const char* words, size_t text_length, size_t word_length);
void stdb_abqerr_(const int* lop, const char* text, const int* integers, const double* reals,
                  const char* words, size_t text_length, size_t word_length) {
    while (text_length > 0 && text[text_length - 1] == ' ')
        --text_length;
    fputs("UMAT: ", stderr);
    for (size_t i = 0; i < text_length; ++i) {
        const char kind = text[i] == '%' && i + 1 < text_length ? text[i + 1] : '\0';
        if (kind == 'I')
            fprintf(stderr, "%d", *integers++);
        else if (kind == 'R')
            fprintf(stderr, "%g", *reals++);
        else if (kind == 'S') {
            fprintf(stderr, "%.*s", (int)word_length, words);
            words += word_length;
        } else {
            fputc(text[i], stderr);
            continue;
        }
        ++i;
    }
    fputc('\n', stderr);
    if (*lop == -3) xit_();
}

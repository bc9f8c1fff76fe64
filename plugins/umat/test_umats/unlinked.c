#include "../umat.h"

void xit_(void);

void umat_(UMAT_ARGUMENTS) {
    xit_();
}

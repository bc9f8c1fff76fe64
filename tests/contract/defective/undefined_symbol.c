double missing_function(double);
double (*wanted)(double) = missing_function;
#include "tiny.h"

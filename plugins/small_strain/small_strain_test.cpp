#include "laboratory.hpp"
#include <gtest/gtest.h>
TEST(X, Y) {}

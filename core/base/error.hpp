// Errors that end a command. The type decides the exit status: 2 the input is wrong, 3 the run failed.
#pragma once
#include <stdexcept>
#include <string>

namespace gault::core {

struct Location { // line and column count from 1; line 0: no position is known
    std::string file;
    int line = 0;
    int column = 0;
    std::string text() const; // "file:line:column", or what is known of it
};

class InputError : public std::runtime_error { // the scene, a plugin file or the command line
  public:
    explicit InputError(const std::string& what) : std::runtime_error(what) {}
    InputError(const Location& where, const std::string& what)
        : std::runtime_error(where.text().empty() ? what : where.text() + ": " + what) {}
};

class RunError : public std::runtime_error { // says at which step, time and point, and what to try
    using std::runtime_error::runtime_error;
};

class InstabilityError : public RunError { // the step may have been too long
    using RunError::RunError;
};

} // namespace gault::core

// One HDF5 file being written. Every failure is a RunError that names the file and the reason.
#pragma once
#include "core/output/results.hpp"

#include <hdf5.h>
#include <utility>

namespace gault::core {

class Hdf5Handle { // closes an HDF5 identifier
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    operator hid_t() const { return id_; }
    hid_t release() { return std::exchange(id_, -1); }

  private:
    hid_t id_;
    Close close_;
};

class Hdf5File {
  public:
    explicit Hdf5File(const std::filesystem::path& file); // replaces what was there
    ~Hdf5File();                                          // removes a file that was not closed
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;

    // Paths are absolute and a dataset's group must exist.
    void group(const std::string& path);
    void attribute(const std::string& object, const std::string& name, double value);
    void attribute(const std::string& object, const std::string& name, const std::string& value); // UTF-8
    // (rows) or (rows, components), row-major, with the attributes `unit` and `description`.
    void numbers(const std::string& path, const ColumnInfo& info, std::size_t rows, int components,
                 const double* values);
    void count(const std::string& path, const std::string& description, std::size_t rows); // 0, 1, 2 ...
    void text(const std::string& path, const std::string& description, const std::string& value);
    void link(const std::string& path, const std::string& relative_file); // to the same path there
    void close(); // the file is complete only after this

  private:
    hid_t check(hid_t result) const;
    void describe(hid_t object, const std::string& unit, const std::string& description);
    void text_attribute(hid_t object, const std::string& name, const std::string& value);

    std::filesystem::path name_;
    Hdf5Handle file_;
    bool complete_ = false;
};

// A dataset of doubles of a closed file into `values`, which holds all of it.
void read_numbers(const std::filesystem::path& file, const std::string& path, double* values);

} // namespace gault::core

// Writes small H5MD files through HDF5's C library, as programs lay them out.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <string>
#include <vector>

#include "tests/foreign/small_files.hpp"

namespace grainreel::small_files {

class H5mdBytes {
  public:
    explicit H5mdBytes(bool h5md = true) : file_("") {
        root_ = H5Fcreate(file_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        EXPECT_GE(root_, 0);
        if (!h5md) return;
        group("h5md/creator");
        word("h5md/creator", "name", "a test");
        word("h5md/creator", "version", "1.2");
    }
    ~H5mdBytes() { close(); }
    H5mdBytes(const H5mdBytes&) = delete;
    H5mdBytes& operator=(const H5mdBytes&) = delete;

    hid_t root() const { return root_; }
    void group(const std::string& path) {
        const hid_t links = with_groups();
        if (H5Lexists(root_, path.substr(0, path.find('/')).c_str(), H5P_DEFAULT) <= 0 ||
            H5Lexists(root_, path.c_str(), H5P_DEFAULT) <= 0)
            H5Gclose(H5Gcreate2(root_, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT));
        H5Pclose(links);
    }
    // A table of doubles, or of `type`. chunk: lengths of its pieces, which are packed then.
    void table(const std::string& path, const std::vector<hsize_t>& shape, const std::vector<double>& values,
               hid_t type = H5T_IEEE_F64LE, const std::vector<hsize_t>& chunk = {}) {
        const std::vector<hsize_t> most(shape.size(), H5S_UNLIMITED);
        const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR)
                                          : H5Screate_simple(static_cast<int>(shape.size()), shape.data(),
                                                             chunk.empty() ? nullptr : most.data());
        const hid_t links = with_groups(), properties = H5Pcreate(H5P_DATASET_CREATE);
        if (!chunk.empty()) {
            H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
            H5Pset_deflate(properties, 6);
        }
        const hid_t data = H5Dcreate2(root_, path.c_str(), type, space, links, properties, H5P_DEFAULT);
        EXPECT_GE(data, 0) << path;
        if (!values.empty()) {
            EXPECT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0)
                << path;
        }
        H5Dclose(data);
        H5Pclose(properties);
        H5Pclose(links);
        H5Sclose(space);
    }
    void word(const std::string& path, const std::string& name, const std::string& value) {
        words(path, name, {value});
    }
    // An attribute of words of one length, as LAMMPS writes them.
    void words(const std::string& path, const std::string& name, const std::vector<std::string>& values) {
        std::size_t width = 1;
        for (const std::string& value : values) width = std::max(width, value.size() + 1);
        std::string all;
        for (std::string value : values) {
            value.resize(width, '\0');
            all += value;
        }
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, width);
        const hsize_t count = values.size();
        const hid_t space = H5Screate_simple(1, &count, nullptr);
        attribute(path, name, type, space, all.data());
        H5Sclose(space);
        H5Tclose(type);
    }
    // An attribute that is one word of any length, as h5py writes it.
    void free_word(const std::string& path, const std::string& name, const std::string& value) {
        const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
        H5Tset_size(type, H5T_VARIABLE);
        const char* text = value.c_str();
        attribute(path, name, type, space, &text);
        H5Sclose(space);
        H5Tclose(type);
    }
    void number(const std::string& path, const std::string& name, double value) {
        const hid_t space = H5Screate(H5S_SCALAR);
        attribute(path, name, H5T_NATIVE_DOUBLE, space, &value);
        H5Sclose(space);
    }
    // The same object by a second name, as ESPResSo shares steps and times.
    void share(const std::string& from, const std::string& to) {
        const hid_t links = with_groups();
        EXPECT_GE(H5Lcreate_hard(root_, from.c_str(), root_, to.c_str(), links, H5P_DEFAULT), 0);
        H5Pclose(links);
    }
    std::string bytes() {
        close();
        return test::text_of(file_.path());
    }

  private:
    static hid_t with_groups() {
        const hid_t links = H5Pcreate(H5P_LINK_CREATE);
        H5Pset_create_intermediate_group(links, 1);
        return links;
    }
    void attribute(const std::string& path, const std::string& name, hid_t type, hid_t space,
                   const void* value) {
        const hid_t object = H5Oopen(root_, path.c_str(), H5P_DEFAULT);
        const hid_t one = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
        EXPECT_GE(H5Awrite(one, type, value), 0) << path << " " << name;
        H5Aclose(one);
        H5Oclose(object);
    }
    void close() {
        if (root_ >= 0) H5Fclose(root_);
        root_ = -1;
    }

    OneFile file_;
    hid_t root_ = -1;
};

}  // namespace grainreel::small_files

#include "engine/files/frames/writers/hdf5_tables.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/files/frames/writers/hdf5_sink.hpp"
#include "engine/files/netcdf/hdf5_handle.hpp"

namespace grainreel {

namespace {

constexpr std::uint64_t kLeastChunk = 256, kMostChunk = 1 << 15;  // rows that are packed together
constexpr unsigned kPacking = 4;                                  // of zlib, from 0 to 9

hid_t type_of(const std::string& name) {
    if (name == "Float64") return H5T_NATIVE_DOUBLE;
    if (name == "Float32") return H5T_NATIVE_FLOAT;
    if (name == "Int64") return H5T_NATIVE_INT64;
    if (name == "Int32") return H5T_NATIVE_INT32;
    if (name == "UInt8") return H5T_NATIVE_UINT8;
    throw std::logic_error(fmt::format("HDF5 tables have no numbers of the type {}", name));
}

template <class Number>
std::string bytes_of(const std::vector<Number>& values) {
    std::string bytes(values.size() * sizeof(Number), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

}  // namespace

Hdf5Tables::Hdf5Tables(const std::filesystem::path& file) : path_(file) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // fault() tells of its faults
    // Tables take much less room in the form of HDF5 1.10 than in the older one.
    const auto access = checked(owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose));
    check(H5Pset_libver_bounds(id_of(access), H5F_LIBVER_V110, H5F_LIBVER_LATEST) >= 0 &&
          write_through_sink(id_of(access), failed_));
    // Nothing notes when it was made, so that the same frames are the same bytes at any time.
    const auto how = checked(owned(H5Pcreate(H5P_FILE_CREATE), H5Pclose));
    check(H5Pset_obj_track_times(id_of(how), 0) >= 0);
    file_ = checked(owned(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, id_of(how), id_of(access)), H5Fclose));
}

void Hdf5Tables::fault() const {
    throw RunError("{}: cannot be written; is the disk full?", path_.string());
}

std::shared_ptr<void> Hdf5Tables::checked(std::shared_ptr<void> handle) const {
    check(handle != nullptr);
    return handle;
}

void Hdf5Tables::check(bool good) const {
    if (!good || failed_) fault();
}

void Hdf5Tables::add_group(const std::string& path, bool ordered) {
    const auto how = checked(owned(H5Pcreate(H5P_GROUP_CREATE), H5Pclose));
    check(H5Pset_obj_track_times(id_of(how), 0) >= 0);
    if (ordered) H5Pset_link_creation_order(id_of(how), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    checked(owned(H5Gcreate2(id_of(file_), path.c_str(), H5P_DEFAULT, id_of(how), H5P_DEFAULT), H5Gclose));
}

void Hdf5Tables::add_link(const std::string& target, const std::string& path) {
    check(H5Lcreate_soft(target.c_str(), id_of(file_), path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

void Hdf5Tables::attribute(const std::string& path, const std::string& name, std::int64_t type,
                           const std::shared_ptr<void>& space, const void* value) const {
    const auto object = checked(owned(H5Oopen(id_of(file_), path.c_str(), H5P_DEFAULT), H5Oclose));
    const auto one = checked(owned(
        H5Acreate2(id_of(object), name.c_str(), type, id_of(space), H5P_DEFAULT, H5P_DEFAULT), H5Aclose));
    check(H5Awrite(id_of(one), type, value) >= 0);
}

// Readers of VTK want words of a fixed length here.
void Hdf5Tables::set_word(const std::string& path, const std::string& name, const std::string& word) {
    const auto type = checked(owned(H5Tcopy(H5T_C_S1), H5Tclose));
    H5Tset_size(id_of(type), std::max<std::size_t>(word.size(), 1));
    H5Tset_strpad(id_of(type), H5T_STR_NULLPAD);
    attribute(path, name, id_of(type), checked(owned(H5Screate(H5S_SCALAR), H5Sclose)), word.data());
}

void Hdf5Tables::set_numbers(const std::string& path, const std::string& name,
                             const std::vector<std::int64_t>& values) {
    const hsize_t count = values.size();
    const auto space =
        checked(owned(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose));
    attribute(path, name, H5T_NATIVE_INT64, space, values.data());
}

// A table that is new is packed in pieces of about as many rows as it first gets.
Hdf5Tables::Table& Hdf5Tables::table(const std::string& path, const std::string& type, std::size_t columns,
                                     std::uint64_t rows) {
    const auto known = tables_.find(path);
    if (known != tables_.end()) return known->second;
    const int rank = columns > 0 ? 2 : 1;
    const std::array<hsize_t, 2> none{0, columns}, most{H5S_UNLIMITED, columns},
        chunk{std::clamp(rows, kLeastChunk, kMostChunk), columns};
    const auto space = checked(owned(H5Screate_simple(rank, none.data(), most.data()), H5Sclose));
    const auto how = checked(owned(H5Pcreate(H5P_DATASET_CREATE), H5Pclose));
    check(H5Pset_chunk(id_of(how), rank, chunk.data()) >= 0 && H5Pset_shuffle(id_of(how)) >= 0 &&
          H5Pset_deflate(id_of(how), kPacking) >= 0 && H5Pset_obj_track_times(id_of(how), 0) >= 0);
    Table one;
    one.columns = columns;
    one.item = H5Tget_size(type_of(type));
    one.data = checked(owned(H5Dcreate2(id_of(file_), path.c_str(), type_of(type), id_of(space), H5P_DEFAULT,
                                        id_of(how), H5P_DEFAULT),
                             H5Dclose));
    return tables_.emplace(path, std::move(one)).first->second;
}

std::int64_t Hdf5Tables::append(const std::string& path, const std::string& type, std::size_t columns,
                                const std::string& bytes) {
    const std::size_t row = std::max<std::size_t>(columns, 1) * H5Tget_size(type_of(type));
    const std::uint64_t rows = bytes.size() / row;
    Table& one = table(path, type, columns, rows);
    const std::uint64_t first = one.rows;
    if (rows == 0) return static_cast<std::int64_t>(first);
    const std::array<hsize_t, 2> size{first + rows, columns}, begin{first, 0}, count{rows, columns};
    check(H5Dset_extent(id_of(one.data), size.data()) >= 0);
    const auto file = checked(owned(H5Dget_space(id_of(one.data)), H5Sclose));
    const auto memory =
        checked(owned(H5Screate_simple(columns > 0 ? 2 : 1, count.data(), nullptr), H5Sclose));
    check(
        H5Sselect_hyperslab(id_of(file), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) >= 0 &&
        H5Dwrite(id_of(one.data), type_of(type), id_of(memory), id_of(file), H5P_DEFAULT, bytes.data()) >= 0);
    one.rows += rows;
    return static_cast<std::int64_t>(first);
}

std::int64_t Hdf5Tables::append(const std::string& path, const std::vector<std::int64_t>& values,
                                std::size_t columns) {
    return append(path, "Int64", columns, bytes_of(values));
}

std::int64_t Hdf5Tables::append(const std::string& path, const std::vector<double>& values,
                                std::size_t columns) {
    return append(path, "Float64", columns, bytes_of(values));
}

std::int64_t Hdf5Tables::rows(const std::string& path) const {
    const auto known = tables_.find(path);
    return known == tables_.end() ? 0 : static_cast<std::int64_t>(known->second.rows);
}

void Hdf5Tables::add_words(const std::string& path, const std::vector<std::string>& words) {
    const auto type = checked(owned(H5Tcopy(H5T_C_S1), H5Tclose));
    H5Tset_size(id_of(type), H5T_VARIABLE);
    const hsize_t count = words.size();
    const auto space = checked(owned(H5Screate_simple(1, &count, nullptr), H5Sclose)),
               how = checked(owned(H5Pcreate(H5P_DATASET_CREATE), H5Pclose));
    H5Pset_obj_track_times(id_of(how), 0);
    const auto data = checked(owned(H5Dcreate2(id_of(file_), path.c_str(), id_of(type), id_of(space),
                                               H5P_DEFAULT, id_of(how), H5P_DEFAULT),
                                    H5Dclose));
    std::vector<const char*> texts;
    texts.reserve(words.size());
    for (const std::string& word : words) texts.push_back(word.c_str());
    check(texts.empty() ||
          H5Dwrite(id_of(data), id_of(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) >= 0);
}

void Hdf5Tables::close() {
    tables_.clear();
    const bool good = H5Fflush(id_of(file_), H5F_SCOPE_LOCAL) >= 0;
    file_.reset();
    check(good);
}

}  // namespace grainreel

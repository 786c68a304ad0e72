#include "engine/files/foreign/h5md/hdf5_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/netcdf/hdf5_handle.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPacking = 1100;                     // the most bytes that zlib makes of one
constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;  // bytes
constexpr std::uint64_t kUsualChunk = std::uint64_t{16} << 20;   // bytes, also of a table with few numbers
constexpr std::uint64_t kMostNames = 10000;
constexpr std::uint64_t kMostText = 1 << 16;  // bytes of an attribute

// Called for a link to another file.
herr_t refuse_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
    return -1;
}

// a·b, or the largest number where it is larger.
std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return b > 0 && a > most / b ? most : a * b;
}

std::uint64_t product_of(const std::vector<std::uint64_t>& lengths) {
    return std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{1}, product);
}

std::vector<std::uint64_t> shape_of(hid_t space) {
    const int rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(rank, 0)));
    if (rank > 0) H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
    return {lengths.begin(), lengths.end()};
}

// What is wrong with how a table is stored; empty if nothing is. bytes: of its numbers. stored: how many of
// the file's bytes it has. size: of the file.
std::string fault_of_storage(hid_t properties, std::uint64_t bytes, std::uint64_t item, std::uint64_t stored,
                             std::uint64_t size) {
    const H5D_layout_t layout = H5Pget_layout(properties);
    if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) > 0)
        return "lies in another file; h5repack FILE NEW makes one file of both";
    const int filters = layout == H5D_CHUNKED ? H5Pget_nfilters(properties) : 0;
    for (int k = 0; k < filters; ++k) {
        unsigned flags = 0, config = 0;
        std::size_t none = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &none, nullptr, 0, nullptr, &config);
        if (H5Zfilter_avail(filter) <= 0)
            return fmt::format(
                "is packed by filter {}, which is not known here; h5repack -f GZIP=6 FILE NEW "
                "packs it otherwise",
                static_cast<int>(filter));
    }
    const std::uint64_t packing = filters > 0 ? kMostPacking : 1;
    if (bytes > product(stored, packing))
        return fmt::format("says that it has {} bytes, which {} bytes in the file cannot hold", bytes,
                           stored);
    if (layout != H5D_CHUNKED) return {};
    std::array<hsize_t, H5S_MAX_RANK> lengths{};
    const int rank = H5Pget_chunk(properties, H5S_MAX_RANK, lengths.data());
    std::uint64_t chunk = item;
    for (int k = 0; k < rank; ++k) chunk = product(chunk, lengths[k]);
    // A piece is unpacked as a whole, so one that is much larger than its table is a trap.
    if (chunk > kLargestChunk || chunk > product(size, packing) || chunk > product(bytes, 4) + kUsualChunk)
        return fmt::format(
            "has pieces (chunks) of {} bytes, too many for a table of {} bytes in a file of {}", chunk, bytes,
            size);
    return {};
}

std::vector<std::string> texts_in(hid_t attribute) {
    const auto type = owned(H5Aget_type(attribute), H5Tclose),
               space = owned(H5Aget_space(attribute), H5Sclose);
    if (!type || !space || H5Tget_class(id_of(type)) != H5T_STRING) return {};
    const std::uint64_t count = product_of(shape_of(id_of(space)));
    std::vector<std::string> texts;
    if (H5Tis_variable_str(id_of(type)) > 0) {
        if (count > kMostText / sizeof(char*)) return {};
        std::vector<char*> words(count, nullptr);
        if (H5Aread(attribute, id_of(type), words.data()) < 0) return {};
        for (const char* word : words) texts.emplace_back(word == nullptr ? "" : word);
        H5Dvlen_reclaim(id_of(type), id_of(space), H5P_DEFAULT, words.data());
        return texts;
    }
    const std::size_t width = H5Tget_size(id_of(type));
    if (width == 0 || count > kMostText / width) return {};
    std::string all(width * count, '\0');
    if (H5Aread(attribute, id_of(type), all.data()) < 0) return {};
    for (std::uint64_t k = 0; k < count; ++k) {
        const std::string word = all.substr(k * width, width);
        texts.push_back(word.substr(0, word.find('\0')));
    }
    return texts;
}

}  // namespace

Hdf5File::Hdf5File(const fs::path& file) : file_(file) {
    check_hdf5(file);
    std::error_code error;
    size_ = fs::file_size(file, error);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // we print its faults in our own words
    links_ = owned(H5Pcreate(H5P_LINK_ACCESS), H5Pclose);
    if (links_) H5Pset_elink_cb(id_of(links_), refuse_link, nullptr);
    const auto access = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (!links_ || !access) refuse_file(file, "the HDF5 library does not work");
    H5Pset_file_locking(id_of(access), 0, 1);  // another program may be writing the file
    handle_ = owned(H5Fopen(file.c_str(), H5F_ACC_RDONLY, id_of(access)), H5Fclose);
    if (!handle_)
        refuse_file(file,
                    "the HDF5 library cannot open it; is it damaged, or is a program still writing it?");
}

std::shared_ptr<void> Hdf5File::open(const std::string& path) const {
    // Each group on the way must be there, or the library counts an error.
    for (std::size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1))
        if (H5Lexists(id_of(handle_), path.substr(0, end).c_str(), id_of(links_)) <= 0) return nullptr;
    if (H5Lexists(id_of(handle_), path.c_str(), id_of(links_)) <= 0) return nullptr;
    return owned(H5Oopen(id_of(handle_), path.c_str(), id_of(links_)), H5Oclose);
}

bool Hdf5File::has_group(const std::string& path) const {
    const auto one = open(path);
    return one && H5Iget_type(id_of(one)) == H5I_GROUP;
}

bool Hdf5File::has_table(const std::string& path) const {
    const auto one = open(path);
    return one && H5Iget_type(id_of(one)) == H5I_DATASET;
}

std::vector<std::string> Hdf5File::names(const std::string& path) const {
    const auto group = open(path);
    H5G_info_t info{};
    if (!group || H5Iget_type(id_of(group)) != H5I_GROUP || H5Gget_info(id_of(group), &info) < 0) return {};
    if (info.nlinks > kMostNames)
        refuse_file(file_, fmt::format("the group {} has {} members, more than {}", excerpt(path),
                                       info.nlinks, kMostNames));
    std::vector<std::string> names;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
        std::array<char, 256> name{};
        const auto length = H5Lget_name_by_idx(id_of(group), ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(),
                                               name.size(), id_of(links_));
        if (length > 0 && static_cast<std::size_t>(length) < name.size()) names.emplace_back(name.data());
    }
    return names;
}

Hdf5Table Hdf5File::table(const std::string& path) const {
    Hdf5Table table;
    table.file_ = file_;
    table.path_ = path;
    table.handle_ = open(path);
    const std::string name = excerpt(path);
    if (!table.handle_ || H5Iget_type(id_of(table.handle_)) != H5I_DATASET)
        refuse_file(file_, fmt::format("{} is missing, or is no table", name));
    const hid_t data = id_of(table.handle_);
    const auto type = owned(H5Dget_type(data), H5Tclose), space = owned(H5Dget_space(data), H5Sclose),
               properties = owned(H5Dget_create_plist(data), H5Pclose);
    if (!type || !space || !properties) refuse_file(file_, fmt::format("{} is damaged", name));
    const H5T_class_t kind = H5Tget_class(id_of(type));
    if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_ENUM)
        refuse_file(file_, fmt::format("{} holds no numbers", name));
    table.shape_ = shape_of(id_of(space));
    const std::uint64_t item = H5Tget_size(id_of(type));
    const std::string fault = fault_of_storage(id_of(properties), product(product_of(table.shape_), item),
                                               item, H5Dget_storage_size(data), size_);
    if (!fault.empty()) refuse_file(file_, fmt::format("{} {}", name, fault));
    H5Pget_fill_value(id_of(properties), H5T_NATIVE_DOUBLE, &table.fill_);
    const int words =
        kind == H5T_ENUM ? std::min(H5Tget_nmembers(id_of(type)), static_cast<int>(kMostNames)) : 0;
    for (int k = 0; k < words; ++k) {
        char* const word = H5Tget_member_name(id_of(type), static_cast<unsigned>(k));
        std::array<char, 64> value{};
        if (word == nullptr || item > value.size()) continue;
        H5Tget_member_value(id_of(type), static_cast<unsigned>(k), value.data());
        const auto base = owned(H5Tget_super(id_of(type)), H5Tclose);
        if (base && H5Tconvert(id_of(base), H5T_NATIVE_DOUBLE, 1, value.data(), nullptr, H5P_DEFAULT) >= 0) {
            table.words_.emplace_back(word);
            table.values_of_words_.push_back(*reinterpret_cast<const double*>(value.data()));
        }
        H5free_memory(word);
    }
    return table;
}

std::vector<double> Hdf5Table::read(std::optional<std::uint64_t> row) const {
    const hid_t data = id_of(handle_);
    const auto space = owned(H5Dget_space(data), H5Sclose);
    std::vector<hsize_t> begin(shape_.size(), 0), count(shape_.begin(), shape_.end());
    if (row && !shape_.empty()) {
        begin.front() = *row;
        count.front() = 1;
    }
    std::vector<double> values(product_of({count.begin(), count.end()}));
    if (values.empty()) return values;
    const hsize_t size = values.size();
    const auto memory = owned(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const bool chosen = space && memory &&
                        (shape_.empty() || H5Sselect_hyperslab(id_of(space), H5S_SELECT_SET, begin.data(),
                                                               nullptr, count.data(), nullptr) >= 0);
    if (!chosen ||
        H5Dread(data, H5T_NATIVE_DOUBLE, id_of(memory), id_of(space), H5P_DEFAULT, values.data()) < 0)
        refuse_file(file_, fmt::format("{} cannot be read; is the file damaged?", excerpt(path_)));
    if (words_.empty()) return values;
    for (double& value : values) {
        const auto word = std::find(values_of_words_.begin(), values_of_words_.end(), value);
        if (word == values_of_words_.end())
            refuse_file(file_, fmt::format("{} has the value {}, for which its enumeration has no word",
                                           excerpt(path_), value));
        value = static_cast<double>(word - values_of_words_.begin());
    }
    return values;
}

std::vector<double> Hdf5Table::numbers() const {
    return read(std::nullopt);
}

std::vector<double> Hdf5Table::row(std::uint64_t index) const {
    return read(index);
}

std::shared_ptr<void> Hdf5File::open_attribute(const std::string& path, const std::string& attribute) const {
    const auto one = open(path);
    if (!one || H5Aexists(id_of(one), attribute.c_str()) <= 0) return nullptr;
    return owned(H5Aopen(id_of(one), attribute.c_str(), H5P_DEFAULT), H5Aclose);
}

std::vector<std::string> Hdf5File::words_of(const std::string& path, const std::string& name) const {
    const auto attribute = open_attribute(path, name);
    return attribute ? texts_in(id_of(attribute)) : std::vector<std::string>();
}

std::optional<double> Hdf5File::number_of(const std::string& path, const std::string& name) const {
    const auto attribute = open_attribute(path, name);
    if (!attribute) return std::nullopt;
    const auto type = owned(H5Aget_type(id_of(attribute)), H5Tclose),
               space = owned(H5Aget_space(id_of(attribute)), H5Sclose);
    if (!type || !space || product_of(shape_of(id_of(space))) != 1) return std::nullopt;
    const H5T_class_t kind = H5Tget_class(id_of(type));
    double value = 0;
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT) ||
        H5Aread(id_of(attribute), H5T_NATIVE_DOUBLE, &value) < 0)
        return std::nullopt;
    return value;
}

}  // namespace grainreel

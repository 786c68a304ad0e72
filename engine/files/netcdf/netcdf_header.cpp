// Reads the header of a NetCDF file without the library and compares it with the file's size, before the
// library opens the file.
#include "engine/files/netcdf/netcdf_file.hpp"

#include <netcdf.h>

#include <array>
#include <fstream>
#include <limits>
#include <system_error>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

using Count = std::uint64_t;

constexpr Count dimension_tag = 10, variable_tag = 11, attribute_tag = 12;
constexpr Count most_bytes = std::numeric_limits<std::int64_t>::max();

Count padded(Count bytes) {
    return (bytes + 3) / 4 * 4;
}

// Number of bytes of a value by the number of its type, or 0 for an unknown type.
Count size_of_type(Count type, int version) {
    constexpr std::array<Count, 12> sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const Count types = version == 5 ? sizes.size() : NC_DOUBLE + 1;
    return type < types ? sizes[type] : 0;
}

class Parser {
  public:
    explicit Parser(const std::filesystem::path& path) : path_(path) {
        std::error_code error;
        if (is_plain(path)) {  // opening a pipe might never end
            size_ = std::filesystem::file_size(path, error);
            in_.open(path, std::ios::binary);
        }
        if (error || !in_.is_open())
            throw UserError("{}: cannot be opened; is it there, and a file?", path.string());
    }

    NetcdfHeader parse() {
        read_magic();
        number(count_width_);  // count of records, which is checked later against the size of the file
        read_dimensions();
        read_attributes();
        read_variables();
        return header();
    }

  private:
    struct Variable {
        Count bytes = 0;  // size of a record, or of the whole variable
        Count begin = 0;
        bool records = false;
    };

    [[noreturn]] void damaged(const char* what) const {
        throw UserError("{}: its header is damaged ({}); copy the file again", path_.string(), what);
    }

    void read_magic() {
        // A run that was killed just now may have made the file, and not yet written its header.
        if (size_ == 0) throw UserError("{}: holds no frame yet: it is empty", path_.string());
        std::array<char, 4> magic{};
        in_.read(magic.data(), magic.size());
        at_ = magic.size();
        version_ = magic[3];
        if (!in_ || magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F' ||
            (version_ != 1 && version_ != 2 && version_ != 5))
            throw UserError("{}: cannot be read: it is no NetCDF file of the classic format", path_.string());
        count_width_ = version_ == 5 ? 8 : 4;
        offset_width_ = version_ == 1 ? 4 : 8;
    }

    Count left() const { return size_ - std::min(at_, size_); }

    // Reads a big-endian number.
    Count number(Count width) {
        std::array<unsigned char, 8> digits{};
        if (left() < width || !in_.read(reinterpret_cast<char*>(digits.data()), std::streamsize(width)))
            damaged("it ends too early");
        at_ += width;
        Count value = 0;
        for (Count i = 0; i < width; ++i) value = value << 8 | digits[i];
        return value;
    }

    void skip(Count bytes) {
        if (bytes > left()) damaged("a length reaches beyond the end of the file");
        in_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
        at_ += bytes;
    }

    void read_name() {
        const Count length = number(count_width_);
        if (length == 0 || length > NC_MAX_NAME) damaged("the length of a name");
        skip(padded(length));
    }

    // The number of entries in a list. Each takes at least `smallest` bytes.
    Count read_list(Count tag, Count smallest) {
        const Count found = number(4), entries = number(count_width_);
        if (found != tag && (found != 0 || entries != 0)) damaged("a list begins with another mark");
        if (entries > left() / smallest) damaged("a list is longer than the file");
        return entries;
    }

    void read_dimensions() {
        const Count entries = read_list(dimension_tag, 4 + 2 * count_width_);
        for (Count i = 0; i < entries; ++i) {
            read_name();
            dimensions_.push_back(number(count_width_));
            if (dimensions_.back() != 0) continue;
            if (unlimited_ < entries) damaged("two dimensions without a length");
            unlimited_ = i;
        }
    }

    void read_attributes() {
        const Count entries = read_list(attribute_tag, 8 + 2 * count_width_);
        for (Count i = 0; i < entries; ++i) {
            read_name();
            const Count size = size_of_type(number(4), version_);
            if (size == 0) damaged("the type of an attribute");
            const Count values = number(count_width_);
            if (values > left() / size) damaged("an attribute is longer than the file");
            skip(padded(values * size));
        }
    }

    void read_variables() {
        const Count entries = read_list(variable_tag, 16 + 3 * count_width_);
        for (Count i = 0; i < entries; ++i) {
            read_name();
            Variable variable;
            Count values = 1;
            read_shape(variable, values);
            read_attributes();
            const Count size = size_of_type(number(4), version_);
            if (size == 0) damaged("the type of a variable");
            if (values > most_bytes / size) damaged("the size of a variable");
            variable.bytes = values * size;
            number(count_width_);  // the size once more; the specification says not to trust it
            variable.begin = number(offset_width_);
            variables_.push_back(variable);
        }
    }

    void read_shape(Variable& variable, Count& values) {
        const Count rank = number(count_width_);
        if (rank > NC_MAX_VAR_DIMS) damaged("the number of a variable's dimensions");
        for (Count d = 0; d < rank; ++d) {
            const Count id = number(count_width_);
            if (id >= dimensions_.size()) damaged("a variable's dimension is none of the file's");
            if (id == unlimited_) {
                if (d > 0) damaged("the dimension of records is not a variable's first");
                variable.records = true;
                continue;
            }
            if (dimensions_[id] > most_bytes / 8 / values) damaged("the size of a variable");
            values *= dimensions_[id];
        }
    }

    NetcdfHeader header() const {
        NetcdfHeader header{size_, 0, static_cast<int>(count_width_)};
        int with_records = 0;
        Count unpadded = 0;
        for (const Variable& variable : variables_) {
            if (variable.begin < at_ || variable.begin > most_bytes) damaged("where a variable begins");
            if (variable.records) {
                header.begin = std::min(header.begin, variable.begin);
                if (variable.bytes > most_bytes - header.record - 3) damaged("the size of a record");
                header.record += padded(variable.bytes);
                unpadded = variable.bytes;
                ++with_records;
            } else if (variable.bytes > size_ || variable.begin > size_ - variable.bytes) {
                damaged("a variable lies beyond the end of the file");
            }
        }
        if (with_records == 1) header.record = unpadded;  // the specification has no padding here
        return header;
    }

    const std::filesystem::path& path_;
    std::ifstream in_;
    Count size_ = 0, at_ = 0;
    int version_ = 0;
    Count count_width_ = 4, offset_width_ = 4;
    std::vector<Count> dimensions_;
    // The number of the unlimited dimension. The largest value stands for none.
    Count unlimited_ = std::numeric_limits<Count>::max();
    std::vector<Variable> variables_;
};

}  // namespace

NetcdfHeader read_netcdf_header(const std::filesystem::path& path) {
    return Parser(path).parse();
}

}  // namespace grainreel

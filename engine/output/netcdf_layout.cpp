#include "engine/output/netcdf_layout.hpp"

#include <netcdf.h>

#include <array>
#include <cstring>
#include <vector>

namespace grainreel {

namespace {

using Bytes = std::uint64_t;

Bytes padded(Bytes bytes) {
    return (bytes + 3) / 4 * 4;
}

Bytes size_of(int file, nc_type type) {
    std::size_t size = 0;
    nc_inq_type(file, type, nullptr, &size);
    return size;
}

class Header {
  public:
    // count: bytes of a number of things, offset: of a place in the file.
    Header(int file, Bytes count, Bytes offset) : file_(file), count_(count), offset_(offset) {}

    Bytes size() const {
        int dimensions = 0, variables = 0, attributes = 0;
        nc_inq(file_, &dimensions, &variables, &attributes, nullptr);
        // The magic and the number of records; then the lists of dimensions, attributes and variables.
        Bytes bytes = 4 + count_ + list() + attribute_list(NC_GLOBAL, attributes) + list();
        for (int i = 0; i < dimensions; ++i) bytes += dimension(i);
        for (int i = 0; i < variables; ++i) bytes += variable(i);
        return bytes;
    }

  private:
    Bytes list() const { return 4 + count_; }  // a tag and a number of entries
    Bytes name(const char* text) const { return count_ + padded(std::strlen(text)); }

    Bytes dimension(int id) const {
        std::array<char, NC_MAX_NAME + 1> text{};
        nc_inq_dimname(file_, id, text.data());
        return name(text.data()) + count_;
    }

    Bytes attribute_list(int variable, int number) const {
        Bytes bytes = list();
        for (int i = 0; i < number; ++i) {
            std::array<char, NC_MAX_NAME + 1> text{};
            nc_type type = NC_NAT;
            std::size_t length = 0;
            nc_inq_attname(file_, variable, i, text.data());
            nc_inq_att(file_, variable, text.data(), &type, &length);
            bytes += name(text.data()) + 4 + count_ + padded(length * size_of(file_, type));
        }
        return bytes;
    }

    Bytes variable(int id) const {
        std::array<char, NC_MAX_NAME + 1> text{};
        int rank = 0, number = 0;
        nc_inq_var(file_, id, text.data(), nullptr, &rank, nullptr, &number);
        return name(text.data()) + count_ * static_cast<Bytes>(rank + 1) + attribute_list(id, number) + 4 +
               count_ + offset_;
    }

    int file_;
    Bytes count_, offset_;
};

struct VariableSize {
    Bytes bytes = 0;  // of a record, or of all
    bool records = false;
};

VariableSize variable_size(int file, int id, int unlimited) {
    nc_type type = NC_NAT;
    int rank = 0;
    std::array<int, NC_MAX_VAR_DIMS> dimensions{};
    nc_inq_var(file, id, nullptr, &type, &rank, dimensions.data(), nullptr);
    VariableSize size{size_of(file, type), rank > 0 && dimensions[0] == unlimited};
    for (int d = size.records ? 1 : 0; d < rank; ++d) {
        std::size_t length = 0;
        nc_inq_dimlen(file, dimensions[static_cast<std::size_t>(d)], &length);
        size.bytes *= length;
    }
    return size;
}

}  // namespace

std::optional<NetcdfLayout> netcdf_layout(int file) {
    int format = 0, variables = 0, unlimited = -1;
    nc_inq_format(file, &format);
    if (format != NC_FORMAT_CLASSIC && format != NC_FORMAT_64BIT_OFFSET && format != NC_FORMAT_64BIT_DATA)
        return std::nullopt;
    NetcdfLayout layout;
    layout.begin =
        Header(file, format == NC_FORMAT_64BIT_DATA ? 8 : 4, format == NC_FORMAT_CLASSIC ? 4 : 8).size();
    nc_inq(file, nullptr, &variables, nullptr, &unlimited);
    int with_records = 0;
    Bytes unpadded = 0;
    for (int i = 0; i < variables; ++i) {
        const VariableSize size = variable_size(file, i, unlimited);
        (size.records ? layout.record : layout.begin) += padded(size.bytes);
        if (size.records) unpadded = size.bytes;
        with_records += size.records ? 1 : 0;
    }
    if (with_records == 1) layout.record = unpadded;  // the specification's one exception
    return layout;
}

}  // namespace grainreel

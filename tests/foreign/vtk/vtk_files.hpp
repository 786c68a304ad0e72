// VTK files that tests write with an encoder of their own, and one bed that all of them hold.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

RawFormat vtk_xml_format();
RawFormat vtk_legacy_format();
RawFormat vtk_collection_format();
RawFormat wall_surface_format();

namespace vtk_test {

using Folder = test::TemporaryFolder;

inline RawFrame frame_in(const RawFormat& format, const std::filesystem::path& file) {
    return format.open(file)->read(0);
}

inline std::string complaint(const std::function<void()>& act) {
    try {
        act();
    } catch (const UserError& error) {
        return error.what();
    }
    return "no complaint";
}
// The message when a file is opened and read.
inline std::string complaint_of(const RawFormat& format, const std::filesystem::path& file) {
    return complaint([&] { frame_in(format, file); });
}

inline std::vector<double> column(const RawTable& table, const std::string& name) {
    const RawColumn* found = table.find(name);
    EXPECT_NE(found, nullptr) << name;
    return found == nullptr ? std::vector<double>() : found->values;
}

// The bed: the values of grain i of `bed_grains`. Numbers have few bits, so that floats hold them.
inline constexpr std::size_t bed_grains = 37;
inline double bed_place(std::size_t i, std::size_t axis) {
    return 0.125 * static_cast<double>((i * (axis + 3) + axis) % 29) - 1;
}
inline double bed_radius(std::size_t i) {
    return 0.03125 * static_cast<double>(1 + i % 3);
}
inline double bed_velocity(std::size_t i, std::size_t axis) {
    return 0.25 * static_cast<double>(i) - static_cast<double>(axis);
}
inline double bed_id(std::size_t i) {
    return static_cast<double>(2 * (bed_grains - i));
}

inline std::vector<double> bed_numbers(const std::function<double(std::size_t, std::size_t)>& of,
                                       std::size_t axes) {
    std::vector<double> values;
    for (std::size_t i = 0; i < bed_grains; ++i)
        for (std::size_t k = 0; k < axes; ++k) values.push_back(of(i, k));
    return values;
}
inline std::vector<double> bed_places() {
    return bed_numbers(bed_place, 3);
}
inline std::vector<double> bed_radii() {
    return bed_numbers([](std::size_t i, std::size_t) { return bed_radius(i); }, 1);
}
inline std::vector<double> bed_velocities() {
    return bed_numbers(bed_velocity, 3);
}
inline std::vector<double> bed_ids() {
    return bed_numbers([](std::size_t i, std::size_t) { return bed_id(i); }, 1);
}
// The numbers first, first + 1, first + 2, ...
inline std::vector<double> counting(std::size_t count, double first = 0) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = first + static_cast<double>(i);
    return values;
}

inline void expect_bed(const RawTable& grains) {
    ASSERT_EQ(grains.rows, bed_grains);
    const std::vector<double> x = column(grains, "x"), y = column(grains, "y"), z = column(grains, "z");
    const std::vector<double> radius = column(grains, "radius"), id = column(grains, "id");
    const std::vector<double> vx = column(grains, "v:0"), vy = column(grains, "v:1"),
                              vz = column(grains, "v:2");
    for (const auto& values : {x, y, z, radius, id, vx, vy, vz}) ASSERT_EQ(values.size(), bed_grains);
    for (std::size_t i = 0; i < bed_grains; ++i) {
        EXPECT_EQ(x[i], bed_place(i, 0));
        EXPECT_EQ(y[i], bed_place(i, 1));
        EXPECT_EQ(z[i], bed_place(i, 2));
        EXPECT_EQ(radius[i], bed_radius(i));
        EXPECT_EQ(id[i], bed_id(i));
        EXPECT_EQ(vx[i], bed_velocity(i, 0));
        EXPECT_EQ(vy[i], bed_velocity(i, 1));
        EXPECT_EQ(vz[i], bed_velocity(i, 2));
    }
}

// How numbers are written.
enum class Form { ascii, base64, appended_raw, appended_base64 };
enum class Packer { none, zlib, lz4 };
struct Coding {
    Form form = Form::ascii;
    Packer packer = Packer::none;
    bool big_endian = false;
    bool wide_header = false;  // UInt64
    std::size_t block = 100;   // bytes of a compressed block; not a multiple of a number's size
};

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = (word << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : letters[(word >> (18 - 6 * k)) & 63u];
    }
    return text;
}

template <class T>
std::string as_bytes(T value, bool big_endian) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

template <class T>
std::string as_bytes_all(const std::vector<double>& values, bool big_endian) {
    std::string bytes;
    for (const double value : values) bytes += as_bytes(static_cast<T>(value), big_endian);
    return bytes;
}

inline std::string bytes_of_numbers(const std::string& type, const std::vector<double>& values, bool big) {
    if (type == "Int8") return as_bytes_all<std::int8_t>(values, big);
    if (type == "UInt8") return as_bytes_all<std::uint8_t>(values, big);
    if (type == "Int16") return as_bytes_all<std::int16_t>(values, big);
    if (type == "UInt16") return as_bytes_all<std::uint16_t>(values, big);
    if (type == "Int32") return as_bytes_all<std::int32_t>(values, big);
    if (type == "UInt32") return as_bytes_all<std::uint32_t>(values, big);
    if (type == "Int64") return as_bytes_all<std::int64_t>(values, big);
    if (type == "UInt64") return as_bytes_all<std::uint64_t>(values, big);
    if (type == "Float32") return as_bytes_all<float>(values, big);
    return as_bytes_all<double>(values, big);
}

inline std::string packed(std::string_view bytes, Packer packer) {
    if (packer == Packer::zlib) {
        uLongf size = compressBound(bytes.size());
        std::string out(size, '\0');
        compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size());
        out.resize(size);
        return out;
    }
    std::string out(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(bytes.size()))), '\0');
    const int size = LZ4_compress_default(bytes.data(), out.data(), static_cast<int>(bytes.size()),
                                          static_cast<int>(out.size()));
    out.resize(static_cast<std::size_t>(size));
    return out;
}

inline std::string header(const std::vector<std::uint64_t>& lengths, const Coding& coding) {
    std::string bytes;
    for (const std::uint64_t length : lengths)
        bytes += coding.wide_header ? as_bytes(length, coding.big_endian)
                                    : as_bytes(static_cast<std::uint32_t>(length), coding.big_endian);
    return bytes;
}

// The bytes of an array as they stand in a file.
inline std::string stored(std::string_view bytes, const Coding& coding) {
    const bool raw = coding.form == Form::appended_raw;
    if (coding.packer == Packer::none) {
        const std::string all = header({bytes.size()}, coding) + std::string(bytes);
        return raw ? all : base64(all);
    }
    std::vector<std::uint64_t> lengths{0, coding.block, bytes.size() % coding.block};
    std::string data;
    for (std::size_t at = 0; at < bytes.size(); at += coding.block) {
        const std::string block = packed(bytes.substr(at, coding.block), coding.packer);
        lengths.push_back(block.size());
        data += block;
        ++lengths[0];
    }
    return raw ? header(lengths, coding) + data : base64(header(lengths, coding)) + base64(data);
}

// Writes a file, one Piece after the other.
class XmlWriter {
  public:
    explicit XmlWriter(const Coding& coding) : coding_(coding) {}

    std::string array(const std::string& type, const std::string& attributes,
                      const std::vector<double>& values) {
        const std::string head = fmt::format("<DataArray type=\"{}\" {} format=", type, attributes);
        if (coding_.form == Form::ascii)
            return fmt::format("{}\"ascii\">\n{}\n</DataArray>\n", head, fmt::join(values, " "));
        const std::string bytes = stored(bytes_of_numbers(type, values, coding_.big_endian), coding_);
        if (coding_.form == Form::base64)
            return fmt::format("{}\"binary\">\n  {}\n</DataArray>\n", head, bytes);
        const std::string tag = fmt::format("{}\"appended\" offset=\"{}\"/>\n", head, appended_.size());
        appended_ += bytes;
        return tag;
    }

    std::string file(const std::string& type, const std::string& inside) const {
        std::string head = fmt::format("<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"{}Endian\"", type,
                                       coding_.big_endian ? "Big" : "Little");
        if (coding_.wide_header) head += " header_type=\"UInt64\"";
        if (coding_.packer != Packer::none)
            head += fmt::format(" compressor=\"vtk{}DataCompressor\"",
                                coding_.packer == Packer::zlib ? "ZLib" : "LZ4");
        std::string tail;
        if (!appended_.empty())
            tail = fmt::format("<AppendedData encoding=\"{}\">\n _{}\n</AppendedData>\n",
                               coding_.form == Form::appended_raw ? "raw" : "base64", appended_);
        return fmt::format("<?xml version=\"1.0\"?>\n{}>\n<{}>\n{}</{}>\n{}</VTKFile>\n", head, type, inside,
                           type, tail);
    }

    std::string points(const std::vector<double>& places, const std::string& name = "Name=\"Points\"") {
        return "<Points>\n" + array("Float32", name + " NumberOfComponents=\"3\"", places) + "</Points>\n";
    }
    std::string cells(const std::string& element, const std::vector<double>& corners,
                      const std::vector<double>& ends) {
        return fmt::format("<{}>\n{}{}</{}>\n", element, array("Int64", "Name=\"connectivity\"", corners),
                           array("Int32", "Name=\"offsets\"", ends), element);
    }

  private:
    Coding coding_;
    std::string appended_{};
};

// The bed as PolyData or UnstructuredGrid, with a vertex cell for each point.
inline std::string bed_file(const Coding& coding, bool poly_data) {
    XmlWriter writer(coding);
    std::string inside =
        poly_data
            ? fmt::format("<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}   \" NumberOfLines=\"0\">\n",
                          bed_grains)
            : fmt::format("<Piece NumberOfPoints=\"{0}\" NumberOfCells=\"{0}\">\n", bed_grains);
    inside += "<PointData>\n" + writer.array("Float64", "Name=\"radius\"", bed_radii()) +
              writer.array("Float32", "Name=\"v\" NumberOfComponents=\"3\"", bed_velocities()) +
              writer.array("Int64", "Name=\"id\"", bed_ids()) + "</PointData>\n<CellData/>\n";
    inside += writer.points(bed_places());
    const std::vector<double> corners = counting(bed_grains), ends = counting(bed_grains, 1);
    if (poly_data)
        inside += writer.cells("Verts", corners, ends);
    else
        inside += "<Cells>\n" + writer.array("Int64", "Name=\"connectivity\"", corners) +
                  writer.array("Int64", "Name=\"offsets\"", ends) +
                  writer.array("UInt8", "Name=\"types\"", std::vector<double>(bed_grains, 1)) + "</Cells>\n";
    return writer.file(poly_data ? "PolyData" : "UnstructuredGrid", inside + "</Piece>\n");
}

}  // namespace vtk_test
}  // namespace grainreel

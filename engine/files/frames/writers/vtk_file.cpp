#include "engine/files/frames/writers/vtk_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <zlib.h>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"

namespace grainreel {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kBlock = std::size_t{1} << 18;  // bytes of an array that are packed at once
constexpr int kLevel = 1;  // of zlib: level 6 makes files 4 % smaller in five times the time

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string packed(const char* bytes, std::size_t size) {
    uLongf room = compressBound(size);
    std::string out(room, '\0');
    const int failed = compress2(reinterpret_cast<Bytef*>(out.data()), &room,
                                 reinterpret_cast<const Bytef*>(bytes), size, kLevel);
    GRAINREEL_CHECK(failed == Z_OK);
    out.resize(room);
    return out;
}

struct Block {
    const VtkArray* array;
    std::size_t from, size;
    std::string out;
};

// Header of a packed array: blocks, size of a block, size of the last one (0: it is full), packed sizes.
std::string with_header(const VtkArray& array, const std::vector<Block>& blocks) {
    std::vector<std::uint64_t> head{0, kBlock, array.bytes.size() % kBlock};
    std::string body;
    for (const Block& block : blocks) {
        if (block.array != &array) continue;
        ++head[0];
        head.push_back(block.out.size());
        body += block.out;
    }
    return bytes_of(head) + body;
}

std::string one_array(const VtkArray& array, std::uint64_t offset) {
    return fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        array.type, array.name, array.components, offset);
}

}  // namespace

VtkArray VtkArray::doubles(std::string name, const std::vector<double>& values, int components) {
    return {std::move(name), "Float64", components, bytes_of(values)};
}

VtkArray VtkArray::floats(std::string name, const std::vector<double>& values, int components) {
    return {std::move(name), "Float32", components,
            bytes_of(std::vector<float>(values.begin(), values.end()))};
}

VtkArray VtkArray::integers(std::string name, const std::vector<std::int64_t>& values) {
    return {std::move(name), "Int64", 1, bytes_of(values)};
}

std::string vtk_bytes(const VtkPolyData& data) {
    const std::size_t cells = data.connectivity.size() / static_cast<std::size_t>(data.points_a_cell);
    std::vector<std::int64_t> offsets(cells);
    for (std::size_t c = 0; c < cells; ++c)
        offsets[c] = static_cast<std::int64_t>(c + 1) * data.points_a_cell;
    std::vector<VtkArray> arrays{VtkArray::doubles("Points", data.points, 3)};
    arrays.insert(arrays.end(), data.point_data.begin(), data.point_data.end());
    arrays.insert(arrays.end(), data.cell_data.begin(), data.cell_data.end());
    arrays.push_back(VtkArray::integers("connectivity", data.connectivity));
    arrays.push_back(VtkArray::integers("offsets", offsets));

    std::vector<Block> blocks;
    for (const VtkArray& array : arrays)
        for (std::size_t from = 0; from < array.bytes.size(); from += kBlock)
            blocks.push_back({&array, from, std::min(kBlock, array.bytes.size() - from), {}});
    Team team(std::max(1, std::min<int>(usable_processors(), static_cast<int>(blocks.size()))));
    team.run([&](int member) {
        for (std::size_t b = static_cast<std::size_t>(member); b < blocks.size();
             b += static_cast<std::size_t>(team.size()))
            blocks[b].out = packed(blocks[b].array->bytes.data() + blocks[b].from, blocks[b].size);
    });
    std::vector<std::uint64_t> place;
    std::string appended;
    for (const VtkArray& array : arrays) {
        place.push_back(appended.size());
        appended += with_header(array, blocks);
    }

    const std::size_t points = data.points.size() / 3;
    const auto count = [&](VtkPolyData::Cells kind) { return data.cells == kind ? cells : 0; };
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\">\n  <PolyData>\n";
    if (data.time)
        text += fmt::format(
            "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">{}</DataArray>\n    </FieldData>\n",
            *data.time);
    text += fmt::format(
        "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        points, count(VtkPolyData::Cells::vertices), count(VtkPolyData::Cells::lines),
        count(VtkPolyData::Cells::triangles));
    std::size_t next = 1;
    const auto listed = [&](const char* section, std::size_t size) {
        text += fmt::format("      <{}>\n", section);
        for (std::size_t k = 0; k < size; ++k, ++next) text += one_array(arrays[next], place[next]);
        text += fmt::format("      </{}>\n", section);
    };
    listed("PointData", data.point_data.size());
    listed("CellData", data.cell_data.size());
    text += "      <Points>\n" + one_array(arrays[0], place[0]) + "      </Points>\n";
    const char* section = data.cells == VtkPolyData::Cells::vertices ? "Verts"
                          : data.cells == VtkPolyData::Cells::lines  ? "Lines"
                                                                     : "Polys";
    listed(section, 2);
    text += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
    return text + appended + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string pvd_text(const std::vector<VtkEntry>& entries) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const VtkEntry& entry : entries)
        text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", entry.time,
                            entry.part, entry.file);
    return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace grainreel

#include "engine/files/frames/writers/vtk_file.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"

namespace grainreel {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kBlock = std::size_t{1} << 18;  // bytes of an array that are packed as one block
constexpr int kLevel = 1;  // zlib's level; level 6 makes files 4 % smaller and takes five times as long

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
    const VtkList* array;
    std::size_t from, size;
    std::string out;
};

// The header of a packed array: number of blocks, size of a block, size of the last one (0 where it is full)
// and the packed sizes.
std::string with_header(const VtkList& array, const std::vector<Block>& blocks) {
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

std::string one_array(const VtkList& array, std::uint64_t offset) {
    return fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        array.type, array.name, array.components, offset);
}

// The packed arrays of a file and the place of each.
class Appended {
  public:
    Appended(const std::vector<const std::vector<VtkList>*>& lists, int threads) {
        std::vector<Block> blocks;
        for (const std::vector<VtkList>* list : lists)
            for (const VtkList& array : *list)
                for (std::size_t from = 0; from < array.bytes.size(); from += kBlock)
                    blocks.push_back({&array, from, std::min(kBlock, array.bytes.size() - from), {}});
        pack(blocks, threads);
        for (const std::vector<VtkList>* list : lists)
            for (const VtkList& array : *list) {
                place_[&array] = bytes_.size();
                bytes_ += with_header(array, blocks);
            }
    }

    std::string section(const char* name, const std::vector<VtkList>& list) const {
        std::string text = fmt::format("      <{}>\n", name);
        for (const VtkList& array : list) text += one_array(array, place_.at(&array));
        return text + fmt::format("      </{}>\n", name);
    }
    // The appended section and the end of the file.
    std::string text() const {
        return "  <AppendedData encoding=\"raw\">\n_" + bytes_ + "\n  </AppendedData>\n</VTKFile>\n";
    }

  private:
    static void pack(std::vector<Block>& blocks, int threads) {
        const int most = threads > 0 ? threads : usable_processors();
        Team team(std::max(1, std::min(most, static_cast<int>(blocks.size()))));
        team.run([&](int member) {
            for (std::size_t b = static_cast<std::size_t>(member); b < blocks.size();
                 b += static_cast<std::size_t>(team.size()))
                blocks[b].out = packed(blocks[b].array->bytes.data() + blocks[b].from, blocks[b].size);
        });
    }

    std::map<const VtkList*, std::uint64_t> place_;
    std::string bytes_;
};

std::string head(const char* type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n",
        type);
}

// A word is written as the bytes of its letters in UTF-8 and a 0, each as a number.
std::string facts_text(const VtkFacts& facts) {
    std::string text;
    if (facts.time)
        text += fmt::format(
            "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">{}</DataArray>\n",
            *facts.time);
    if (facts.step)
        text += fmt::format(
            "      <DataArray type=\"Int64\" Name=\"CYCLE\" NumberOfTuples=\"1\" "
            "format=\"ascii\">{}</DataArray>\n",
            *facts.step);
    for (const auto& [name, words] : facts.words) {
        text +=
            fmt::format("      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
                        name, words.size());
        for (const std::string& word : words) {
            for (const char c : word) text += fmt::format("{} ", static_cast<unsigned char>(c));
            text += "0 ";
        }
        text += "</Array>\n";
    }
    return text.empty() ? text : "    <FieldData>\n" + text + "    </FieldData>\n";
}

}  // namespace

VtkList VtkList::doubles(std::string name, const std::vector<double>& values, int components) {
    return {std::move(name), "Float64", components, bytes_of(values)};
}

VtkList VtkList::integers(std::string name, const std::vector<std::int64_t>& values) {
    return {std::move(name), "Int64", 1, bytes_of(values)};
}

std::string vtk_bytes(const VtkPolyData& data, int threads) {
    const std::size_t cells = data.connectivity.size() / static_cast<std::size_t>(data.points_a_cell);
    std::vector<std::int64_t> offsets(cells);
    for (std::size_t c = 0; c < cells; ++c)
        offsets[c] = static_cast<std::int64_t>(c + 1) * data.points_a_cell;
    const std::vector<VtkList> points{VtkList::doubles("Points", data.points, 3)};
    const std::vector<VtkList> topology{VtkList::integers("connectivity", data.connectivity),
                                        VtkList::integers("offsets", offsets)};
    const auto count = [&](VtkPolyData::Cells kind) { return data.cells == kind ? cells : 0; };
    Appended arrays({&points, &data.point_data, &data.cell_data, &topology}, threads);
    std::string text = head("PolyData") + "  <PolyData>\n" + facts_text(data.facts);
    text += fmt::format(
        "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        data.points.size() / 3, count(VtkPolyData::Cells::vertices), count(VtkPolyData::Cells::lines),
        count(VtkPolyData::Cells::triangles));
    text += arrays.section("PointData", data.point_data) + arrays.section("CellData", data.cell_data) +
            arrays.section("Points", points);
    const char* section = data.cells == VtkPolyData::Cells::vertices ? "Verts"
                          : data.cells == VtkPolyData::Cells::lines  ? "Lines"
                                                                     : "Polys";
    text += arrays.section(section, topology) + "    </Piece>\n  </PolyData>\n";
    return text + arrays.text();
}

std::string vtk_bytes(const VtkImage& image, int threads) {
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", image.cells[0], image.cells[1], image.cells[2]);
    Appended arrays({&image.cell_data}, threads);
    std::string text = head("ImageData");
    text += fmt::format("  <ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n", extent,
                        image.origin[0], image.origin[1], image.origin[2], image.spacing[0], image.spacing[1],
                        image.spacing[2]);
    text += facts_text(image.facts) + fmt::format("    <Piece Extent=\"{}\">\n", extent);
    text += arrays.section("CellData", image.cell_data) + "    </Piece>\n  </ImageData>\n";
    return text + arrays.text();
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

namespace {

// The row of an id in the frame, or the number of rows where there is no such grain.
std::size_t row_of(const State& frame, std::int32_t id) {
    return frame.row_of(id).value_or(frame.size());
}

// Subtracts whole edges of the periodic cell from a vector, so that it leads to the nearest image.
Vec3 shortest(Vec3 way, const StoredWorld& world) {
    if (!world.cell) return way;
    for (std::size_t edge = 3; edge-- > 0;) {
        const Vec3& along = world.cell->edges[edge];
        const double length = along[static_cast<Eigen::Index>(edge)];
        if (world.cell->periodic[edge] && length > 0)
            way -= std::round(way[static_cast<Eigen::Index>(edge)] / length) * along;
    }
    return way;
}

// The vector from the first grain's centre to the second's, or to the point of contact on a wall.
Vec3 way_of(const State& frame, const SavedContact& contact, std::size_t first, std::size_t second,
            const StoredWorld& world) {
    const Vec3 end = second < frame.size() ? frame.position[second] : contact.point;
    return shortest(end - frame.position[first], world);
}

Vec3 direction(const Vec3& way) {
    const double length = way.norm();
    return length > 0 ? Vec3(way / length) : Vec3(0, 0, 0);
}

void put(std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x(), v.y(), v.z()});
}

class Lines {
  public:
    Lines() {
        data_.cells = VtkPolyData::Cells::lines;
        data_.points_a_cell = 2;
    }
    void add(const Vec3& from, const Vec3& to, std::int32_t first, std::int32_t second, double normal) {
        for (const Vec3& end : {from, to}) {
            data_.connectivity.push_back(static_cast<std::int64_t>(data_.points.size() / 3));
            put(data_.points, end);
        }
        normal_.push_back(normal);
        first_.push_back(first);
        second_.push_back(second);
        wall_.push_back(second < 0 ? 1 : 0);
    }
    VtkPolyData data() {
        data_.cell_data = {VtkList::doubles("normal_force", normal_), VtkList::integers("id1", first_),
                           VtkList::integers("id2", second_), VtkList::integers("to_wall", wall_)};
        return std::move(data_);
    }

  private:
    VtkPolyData data_;
    std::vector<double> normal_;
    std::vector<std::int64_t> first_, second_, wall_;
};

}  // namespace

VtkPolyData contact_lines(const State& frame, const std::vector<SavedContact>& contacts,
                          const StoredWorld& world) {
    Lines lines;
    std::vector<double> tangential, force;
    for (const SavedContact& contact : contacts) {
        const std::size_t a = row_of(frame, contact.first);
        const std::size_t b = contact.second < 0 ? frame.size() : row_of(frame, contact.second);
        if (a == frame.size() || (contact.second >= 0 && b == frame.size())) continue;
        const Vec3 way = way_of(frame, contact, a, b, world);
        lines.add(frame.position[a], frame.position[a] + way, contact.first, contact.second, contact.normal);
        put(tangential, contact.tangential);
        put(force, contact.normal * direction(way) + contact.tangential);
    }
    VtkPolyData data = lines.data();
    data.cell_data.push_back(VtkList::doubles("tangential_force", tangential, 3));
    data.cell_data.push_back(VtkList::doubles("force", force, 3));
    return data;
}

VtkPolyData contact_lines(const State& frame, const std::vector<Link>& touches, const StoredWorld& world) {
    Lines lines;
    for (const Link& touch : touches) {
        const std::size_t a = row_of(frame, touch.first);
        const std::size_t b = touch.second < 0 ? frame.size() : row_of(frame, touch.second);
        if (a == frame.size() || b == frame.size()) continue;
        const Vec3 way = shortest(frame.position[b] - frame.position[a], world);
        lines.add(frame.position[a], frame.position[a] + way, touch.first, touch.second, touch.force);
    }
    return lines.data();
}

std::vector<Vec3> forces_on_grains(const State& frame, const std::vector<SavedContact>& contacts,
                                   const StoredWorld& world) {
    std::vector<Vec3> forces(frame.size(), Vec3(0, 0, 0));
    for (const SavedContact& contact : contacts) {
        const std::size_t a = row_of(frame, contact.first);
        const std::size_t b = contact.second < 0 ? frame.size() : row_of(frame, contact.second);
        if (a == frame.size() || (contact.second >= 0 && b == frame.size())) continue;
        const Vec3 on_second =
            contact.normal * direction(way_of(frame, contact, a, b, world)) + contact.tangential;
        forces[a] -= on_second;
        if (b < frame.size()) forces[b] += on_second;
    }
    return forces;
}

}  // namespace grainreel

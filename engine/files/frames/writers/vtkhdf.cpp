// Writes VTKHDF (docs.vtk.org, "VTKHDF file format", version 2.1): a whole run as one HDF5 file for ParaView
// 5.13 or newer. It is a PartitionedDataSetCollection with the blocks grains, walls and contacts, each a
// PolyData over time.
//
// Cells of a block are always the first so many of one list, because its grains are points 0, 1, 2 and so on,
// its contacts lines of points 0 and 1, 2 and 3 and so on, and its walls the same triangles. So the list is
// stored once. Numbers that are the same as in the frame before (radii, walls at rest) are not stored again:
// a step has an offset into each table.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/files/frames/writers/hdf5_tables.hpp"
#include "engine/files/frames/writers/vtk_parts.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"

namespace grainreel {

namespace {

constexpr std::array<const char*, 4> kTopologies{"Vertices", "Lines", "Polygons", "Strips"};

std::size_t topology_of(VtkPolyData::Cells cells) {
    return cells == VtkPolyData::Cells::vertices ? 0 : cells == VtkPolyData::Cells::lines ? 1 : 2;
}

// A block of the file.
class Block {
  public:
    // file: must outlive the block. number: of the block, from 0.
    Block(Hdf5Tables& file, const std::string& name, int number);

    void add(const VtkPolyData& data, double time);
    // Tells how many steps there are. Nothing is added afterwards.
    void end();

  private:
    // What a table had in the step before.
    struct Stored {
        std::string bytes;
        std::int64_t row = 0;
    };
    std::string path(const std::string& name) const { return group_ + "/" + name; }
    void add_counts(std::int64_t points, std::size_t topology, std::int64_t cells, std::int64_t corners);
    void add_cells(const VtkPolyData& data, std::size_t topology, std::int64_t cells);
    void add_arrays(const std::string& kind, const std::vector<VtkList>& arrays, std::int64_t rows);
    void add_words(const VtkPolyData& data);
    std::int64_t store(const std::string& table, const std::string& type, int components,
                       const std::string& bytes);

    Hdf5Tables& file_;
    std::string group_;
    std::int64_t steps_ = 0;
    std::array<std::int64_t, 3> counts_{-1, -1, -1};  // points, cells and their points in the step before
    std::map<std::string, Stored> stored_;
    std::map<std::string, std::int64_t> most_rows_;  // of all steps so far
};

Block::Block(Hdf5Tables& file, const std::string& name, int number) : file_(file), group_("/VTKHDF/" + name) {
    file_.add_group(group_);
    file_.set_numbers(group_, "Version", {2, 1});
    file_.set_word(group_, "Type", "PolyData");
    file_.set_numbers(group_, "Index", {number});
    for (const char* part : {"PointData", "CellData", "FieldData", "Steps", "Steps/PointDataOffsets",
                             "Steps/CellDataOffsets", "Steps/FieldDataOffsets", "Steps/FieldDataSizes"})
        file_.add_group(path(part));
    for (const char* topology : kTopologies) {
        const std::string one = path(topology);
        file_.add_group(one);
        file_.append(one + "/Offsets", std::vector<std::int64_t>{0});
        file_.append(one + "/Connectivity", std::vector<std::int64_t>());
    }
}

// The row of a table from which the bytes are. Bytes of the step before are not stored again.
std::int64_t Block::store(const std::string& table, const std::string& type, int components,
                          const std::string& bytes) {
    const std::size_t columns = components > 1 ? static_cast<std::size_t>(components) : 0;
    const auto [before, is_new] = stored_.try_emplace(table);
    if (!is_new && before->second.bytes == bytes) return before->second.row;
    before->second = {bytes, file_.append(table, type, columns, bytes)};
    return before->second.row;
}

void Block::add_counts(std::int64_t points, std::size_t topology, std::int64_t cells, std::int64_t corners) {
    const std::array<std::int64_t, 3> now{points, cells, corners};
    if (now != counts_) {
        file_.append(path("NumberOfPoints"), std::vector<std::int64_t>{points});
        for (std::size_t k = 0; k < kTopologies.size(); ++k) {
            const std::string one = path(kTopologies[k]);
            file_.append(one + "/NumberOfCells", std::vector<std::int64_t>{k == topology ? cells : 0});
            file_.append(one + "/NumberOfConnectivityIds",
                         std::vector<std::int64_t>{k == topology ? corners : 0});
        }
    }
    counts_ = now;
    file_.append(path("Steps/NumberOfParts"), std::vector<std::int64_t>{1});
    file_.append(path("Steps/PartOffsets"),
                 std::vector<std::int64_t>{file_.rows(path("NumberOfPoints")) - 1});
}

void Block::add_cells(const VtkPolyData& data, std::size_t topology, std::int64_t cells) {
    const std::string one = path(kTopologies[topology]);
    const std::vector<std::int64_t>& corners = data.connectivity;
    const std::int64_t stored = file_.rows(one + "/Connectivity");
    if (static_cast<std::int64_t>(corners.size()) > stored)
        file_.append(one + "/Connectivity",
                     std::vector<std::int64_t>(corners.begin() + stored, corners.end()));
    std::vector<std::int64_t> ends;
    for (std::int64_t cell = file_.rows(one + "/Offsets"); cell <= cells; ++cell)
        ends.push_back(cell * data.points_a_cell);
    file_.append(one + "/Offsets", ends);
    for (const char* table : {"Steps/CellOffsets", "Steps/ConnectivityIdOffsets"})
        file_.append(path(table), std::vector<std::int64_t>(kTopologies.size(), 0), kTopologies.size());
}

// An array that comes later than the first step is NaN, or 0 if it is whole, in the steps before.
void Block::add_arrays(const std::string& kind, const std::vector<VtkList>& arrays, std::int64_t rows) {
    for (const VtkList& array : arrays) {
        const std::string table = path(kind) + "/" + array.name,
                          offsets = path("Steps/" + kind + "Offsets") + "/" + array.name;
        if (!file_.has(offsets) && steps_ > 0) {
            const std::size_t count =
                static_cast<std::size_t>(most_rows_[kind]) * static_cast<std::size_t>(array.components);
            const VtkList none = array.type == "Int64"
                                     ? VtkList::integers(array.name, std::vector<std::int64_t>(count, 0))
                                     : VtkList::doubles(array.name, std::vector<double>(count, kUnknown));
            store(table, none.type, array.components, none.bytes);
            file_.append(offsets, std::vector<std::int64_t>(static_cast<std::size_t>(steps_), 0));
        }
        file_.append(offsets,
                     std::vector<std::int64_t>{store(table, array.type, array.components, array.bytes)});
    }
    most_rows_[kind] = std::max(most_rows_[kind], rows);
}

// Names of species and walls are the same in all steps.
void Block::add_words(const VtkPolyData& data) {
    for (const auto& [name, words] : data.facts.words) {
        if (words.empty()) continue;
        if (steps_ == 0) file_.add_words(path("FieldData") + "/" + name, words);
        file_.append(path("Steps/FieldDataOffsets") + "/" + name, std::vector<std::int64_t>{0});
        file_.append(path("Steps/FieldDataSizes") + "/" + name,
                     std::vector<std::int64_t>{1, static_cast<std::int64_t>(words.size())}, 2);
    }
}

void Block::add(const VtkPolyData& data, double time) {
    const auto points = static_cast<std::int64_t>(data.points.size() / 3),
               corners = static_cast<std::int64_t>(data.connectivity.size()),
               cells = corners / data.points_a_cell;
    const std::size_t topology = topology_of(data.cells);
    file_.append(path("Steps/Values"), std::vector<double>{time});
    add_counts(points, topology, cells, corners);
    const VtkList places = VtkList::doubles("Points", data.points, 3);
    file_.append(path("Steps/PointOffsets"),
                 std::vector<std::int64_t>{store(path("Points"), places.type, 3, places.bytes)});
    add_cells(data, topology, cells);
    add_arrays("PointData", data.point_data, points);
    add_arrays("CellData", data.cell_data, cells);
    add_words(data);
    ++steps_;
}

void Block::end() {
    file_.set_numbers(path("Steps"), "NSteps", {steps_});
}

class VtkHdf final : public VtkWriter {
  public:
    explicit VtkHdf(const std::filesystem::path& path) : path_(path) {}
    ~VtkHdf() override {
        const std::lock_guard lock(hdf5_library());
        file_.reset();
    }
    VtkHdf(const VtkHdf&) = delete;
    VtkHdf& operator=(const VtkHdf&) = delete;

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        VtkWriter::begin(world, supply);
        const std::lock_guard lock(hdf5_library());
        file_.emplace(path_);
        file_->add_group("/VTKHDF", true);
        file_->set_numbers("/VTKHDF", "Version", {2, 1});
        file_->set_word("/VTKHDF", "Type", "PartitionedDataSetCollection");
        add_block(grains_, "grains");
        if (has_walls()) add_block(walls_, "walls");
        if (supply_.contacts) add_block(contacts_block_, "contacts");
        file_->add_group("/VTKHDF/Assembly", true);
        for (const std::string& name : blocks_) {
            const std::string node = "/VTKHDF/Assembly/" + name;  // which gives the block its name
            file_->add_group(node, true);
            file_->add_link("/VTKHDF/" + name, node + "/" + name);
        }
    }
    void fields(const FieldsReader&, const std::vector<std::size_t>& records) override {
        left_out_ = !records.empty();
    }
    void end() override {
        const std::lock_guard lock(hdf5_library());
        for (std::optional<Block>* block : {&grains_, &walls_, &contacts_block_})
            if (*block) (*block)->end();
        file_->close();
    }
    std::vector<std::string> news() const override {
        if (!left_out_) return {};
        return {"VTKHDF has no place for the run's fields; export --to vtk writes them"};
    }

  private:
    void write(const State& frame, Parts parts) override {
        const double time = time_of(frame);
        const std::lock_guard lock(hdf5_library());
        grains_->add(parts.grains, time);
        if (parts.walls) walls_->add(*parts.walls, time);
        if (parts.contacts) contacts_block_->add(*parts.contacts, time);
    }
    void add_block(std::optional<Block>& block, const std::string& name) {
        block.emplace(*file_, name, static_cast<int>(blocks_.size()));
        blocks_.push_back(name);
    }

    std::filesystem::path path_;
    std::optional<Hdf5Tables> file_;
    std::vector<std::string> blocks_;
    std::optional<Block> grains_, walls_, contacts_block_;
    bool left_out_ = false;  // whether the run has fields
};

}  // namespace

WriteFormat vtkhdf_format() {
    return {"vtkhdf", "VTKHDF for ParaView 5.13 and newer: grains, walls and contacts in one file", ".vtkhdf",
            make_writer<VtkHdf>};
}

}  // namespace grainreel

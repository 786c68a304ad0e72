// Writes a folder for ParaView and VTK. grains.pvd, walls.pvd and contacts.pvd list a .vtp file for each
// moment; run.pvd lists all of them as parts; fields.pvd lists a .vti file for each record of fields.nc.
// Arrays have the names that other programs read: id, type (from 1, as in LAMMPS), omega.
#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/frames/writers/vtk_parts.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Joins the components of a vector or tensor into one array in VTK's order. A scalar stays as it is.
std::vector<VtkList> joined(const std::vector<std::string>& names,
                            const std::vector<std::vector<double>>& values) {
    const std::vector<std::vector<std::string>> kinds{
        {"_xx", "_xy", "_xz", "_yx", "_yy", "_yz", "_zx", "_zy", "_zz"},
        {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"},
        {"_x", "_y", "_z"}};
    std::map<std::string, std::size_t> place;
    for (std::size_t k = 0; k < names.size(); ++k) place[names[k]] = k;
    std::vector<bool> taken(names.size(), false);
    std::vector<VtkList> arrays;
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (taken[k]) continue;
        std::vector<std::size_t> parts{k};
        std::string name = names[k];
        for (const std::vector<std::string>& ends : kinds) {
            if (!names[k].ends_with(ends.front())) continue;
            const std::string stem = names[k].substr(0, names[k].size() - ends.front().size());
            std::vector<std::size_t> found;
            for (const std::string& end : ends)
                if (const auto at = place.find(stem + end); at != place.end()) found.push_back(at->second);
            if (found.size() != ends.size()) continue;
            parts = found;
            name = stem;
            break;
        }
        std::vector<double> numbers;
        for (std::size_t cell = 0; cell < values[k].size(); ++cell)
            for (const std::size_t part : parts) numbers.push_back(values[part][cell]);
        for (const std::size_t part : parts) taken[part] = true;
        arrays.push_back(VtkList::doubles(name, numbers, static_cast<int>(parts.size())));
    }
    return arrays;
}

// Along an axis without cells the image has one cell that is as wide as the world.
VtkImage grid_of(const FieldsReader& fields, const StoredWorld& world) {
    VtkImage image;
    const std::array<double, 3> cell = fields.cell();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        const std::vector<double>& middles = fields.middles()[axis];
        const double width = world.high[a] - world.low[a];
        image.cells[axis] = std::max<std::size_t>(1, middles.size());
        image.spacing[axis] = !middles.empty() ? cell[axis] : width > 0 ? width : 1;
        image.origin[axis] = !middles.empty() ? middles.front() - 0.5 * cell[axis] : world.low[a];
    }
    return image;
}

class Vtk final : public VtkWriter {
  public:
    explicit Vtk(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) throw RunError("{}: cannot be made: {}", folder_.string(), error.message());
    }
    void fields(const FieldsReader& fields, const std::vector<std::size_t>& records) override {
        if (fields.names().empty()) return;
        std::vector<VtkEntry> entries;
        for (const std::size_t record : records) {
            const auto [begin, end] = fields.span(record);
            VtkImage image = grid_of(fields, world_);
            image.cell_data = joined(fields.names(), fields.read(record));
            image.facts.time = 0.5 * (begin + end);
            const std::string file = fmt::format("fields_{:06d}.vti", entries.size());
            TextFile(folder_ / file).write(vtk_bytes(image));
            entries.push_back({*image.facts.time, 0, file});
        }
        if (!entries.empty()) TextFile(folder_ / "fields.pvd").write(pvd_text(entries));
    }
    void end() override {
        const char* names[] = {"grains", "walls", "contacts"};
        for (int part = 0; part < 3; ++part) {
            std::vector<VtkEntry> some;
            for (const VtkEntry& entry : entries_)
                if (entry.part == part) some.push_back({entry.time, 0, entry.file});
            if (!some.empty()) TextFile(folder_ / fmt::format("{}.pvd", names[part])).write(pvd_text(some));
        }
        TextFile(folder_ / "run.pvd").write(pvd_text(entries_));
    }

  private:
    void write(const State& frame, Parts parts) override {
        write("grains", 0, frame, std::move(parts.grains));
        if (parts.walls) write("walls", 1, frame, std::move(*parts.walls));
        if (parts.contacts) write("contacts", 2, frame, std::move(*parts.contacts));
    }
    void write(const char* name, int part, const State& frame, VtkPolyData data) {
        const double time = time_of(frame);
        if (world_.time_known) data.facts.time = time;
        if (world_.steps_known) data.facts.step = frame.step;
        const std::string file = fmt::format("{}_{:06d}.vtp", name, frames_);
        TextFile(folder_ / file).write(vtk_bytes(data));
        entries_.push_back({time, part, file});
    }

    fs::path folder_;
    std::vector<VtkEntry> entries_;
};

}  // namespace

WriteFormat vtk_format() {
    return {"vtk", "folder for ParaView and VTK: grains, walls, contacts, fields (.pvd, .vtp, .vti)", "-vtk",
            make_writer<Vtk>};
}

}  // namespace grainreel

// A folder for ParaView and VTK: grains.pvd, walls.pvd and contacts.pvd with a .vtp file for each moment, and
// run.pvd with all of them as parts.
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text_file.hpp"
#include "engine/files/frames/frame_writer.hpp"
#include "engine/files/frames/world_surfaces.hpp"
#include "engine/files/frames/writers/vtk_file.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

void add(std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x(), v.y(), v.z()});
}

VtkPolyData grains_of(const Frame& frame, const FrameSupply& supply) {
    VtkPolyData data;
    std::vector<double> radius, velocity, spin;
    std::vector<std::int64_t> id, species, contacts;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        add(data.points, frame.position[i]);
        data.connectivity.push_back(static_cast<std::int64_t>(i));
        radius.push_back(frame.radius[i]);
        id.push_back(frame.id[i]);
        species.push_back(frame.species[i]);
        add(velocity, frame.velocity[i]);
        add(spin, frame.spin[i]);
        if (i < frame.contact_number.size()) contacts.push_back(frame.contact_number[i]);
    }
    data.point_data = {VtkArray::doubles("radius", radius), VtkArray::integers("id", id),
                       VtkArray::integers("type", species)};
    if (supply.velocities) {
        data.point_data.push_back(VtkArray::doubles("velocity", velocity, 3));
        data.point_data.push_back(VtkArray::doubles("omega", spin, 3));
    }
    if (contacts.size() == frame.size() && !contacts.empty())
        data.point_data.push_back(VtkArray::integers("contact_number", contacts));
    return data;
}

// Lines from centre to centre; to walls from the centre down to nothing, so these are left out.
VtkPolyData contacts_of(const Frame& frame) {
    VtkPolyData data;
    data.cells = VtkPolyData::Cells::lines;
    data.points_a_cell = 2;
    std::vector<double> force;
    std::vector<std::int64_t> first, second;
    const auto row = [&](std::int32_t id) {
        const auto found = std::lower_bound(frame.id.begin(), frame.id.end(), id);
        return found == frame.id.end() || *found != id ? frame.size()
                                                       : static_cast<std::size_t>(found - frame.id.begin());
    };
    for (const Touch& touch : frame.touches) {
        const std::size_t a = row(touch.first), b = touch.second < 0 ? frame.size() : row(touch.second);
        if (a == frame.size() || b == frame.size()) continue;
        for (const std::size_t end : {a, b}) {
            data.connectivity.push_back(static_cast<std::int64_t>(data.points.size() / 3));
            add(data.points, frame.position[end]);
        }
        force.push_back(touch.force);
        first.push_back(touch.first);
        second.push_back(touch.second);
    }
    data.cell_data = {VtkArray::doubles("normal_force", force), VtkArray::integers("id1", first),
                      VtkArray::integers("id2", second)};
    return data;
}

VtkPolyData walls_of(const std::vector<WorldSurface>& surfaces, const Frame& frame) {
    VtkPolyData data;
    data.cells = VtkPolyData::Cells::triangles;
    data.points_a_cell = 3;
    std::vector<std::int64_t> number;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const TriangleMesh mesh = moved(surfaces[s], frame);
        const auto first = static_cast<std::int64_t>(data.points.size() / 3);
        for (const Vec3& vertex : mesh.vertices) add(data.points, vertex);
        for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
            for (const std::int32_t vertex : triangle) data.connectivity.push_back(first + vertex);
            number.push_back(static_cast<std::int64_t>(s));
        }
    }
    data.cell_data = {VtkArray::integers("wall", number)};
    return data;
}

class Vtk final : public FrameWriter {
  public:
    explicit Vtk(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) throw RunError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
    }

    void begin(const World& world, const FrameSupply& supply) override {
        supply_ = supply;
        surfaces_ = surfaces_of(world);
    }
    void frame(const Frame& frame) override {
        write("grains", 0, frame, grains_of(frame, supply_));
        if (!surfaces_.empty()) write("walls", 1, frame, walls_of(surfaces_, frame));
        if (supply_.contacts) write("contacts", 2, frame, contacts_of(frame));
        ++frames_;
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
    void write(const char* name, int part, const Frame& frame, VtkPolyData data) {
        data.time = frame.time;
        const std::string file = fmt::format("{}_{:06d}.vtp", name, frames_);
        TextFile(folder_ / file).write(vtk_bytes(data));
        entries_.push_back({frame.time, part, file});
    }

    fs::path folder_;
    FrameSupply supply_;
    std::vector<WorldSurface> surfaces_;
    std::vector<VtkEntry> entries_;
    std::int64_t frames_ = 0;
};

std::unique_ptr<FrameWriter> make(const fs::path& path) {
    return std::make_unique<Vtk>(path);
}

}  // namespace

FrameFormat vtk_format() {
    return {"vtk", "folder for ParaView and VTK: grains, walls, contacts (.pvd, .vtp)", "-vtk", make};
}

}  // namespace grainreel

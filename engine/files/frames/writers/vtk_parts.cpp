#include "engine/files/frames/writers/vtk_parts.hpp"

#include "engine/base/numbers.hpp"

namespace grainreel {

namespace {

void add_to(std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x(), v.y(), v.z()});
}

VtkPolyData grain_points(const State& frame, const StoredWorld& world, const StateSupply& supply) {
    VtkPolyData data;
    std::vector<double> radius, velocity, spin;
    std::vector<std::int64_t> id, type, contacts;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        add_to(data.points, frame.position[i]);
        data.connectivity.push_back(static_cast<std::int64_t>(i));
        radius.push_back(frame.radius[i]);
        id.push_back(frame.id[i]);
        type.push_back(frame.species[i] + 1);
        add_to(velocity, frame.velocity[i]);
        add_to(spin, frame.spin[i]);
        if (i < frame.contact_number.size()) contacts.push_back(frame.contact_number[i]);
    }
    data.point_data = {VtkList::doubles("radius", radius), VtkList::integers("id", id),
                       VtkList::integers("type", type)};
    if (supply.velocities) data.point_data.push_back(VtkList::doubles("velocity", velocity, 3));
    if (supply.spins) data.point_data.push_back(VtkList::doubles("omega", spin, 3));
    if (supply.masses) data.point_data.push_back(VtkList::doubles("mass", frame.mass));
    if (supply.contact_numbers) {
        contacts.resize(frame.size(), -1);
        data.point_data.push_back(VtkList::integers("contact_number", contacts));
    }
    std::vector<std::string> names;
    for (const WorldSpecies& species : world.species) names.push_back(species.name);
    data.facts.words.emplace_back("species", names);
    return data;
}

// The sum of forces on each grain; NaN where none are known.
VtkList force_array(const State& frame, const std::optional<std::vector<SavedContact>>& contacts,
                    const StoredWorld& world) {
    std::vector<Vec3> forces;
    if (contacts) forces = forces_on_grains(frame, *contacts, world);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < frame.size(); ++i)
        add_to(numbers, contacts ? forces[i] : Vec3(kUnknown, kUnknown, kUnknown));
    return VtkList::doubles("force", numbers, 3);
}

// The surfaces in their places at that moment. "wall" is the number of a triangle's surface.
VtkPolyData wall_triangles(const std::vector<WorldSurface>& surfaces, const State& frame) {
    VtkPolyData data;
    data.cells = VtkPolyData::Cells::triangles;
    data.points_a_cell = 3;
    std::vector<std::int64_t> number;
    std::vector<std::string> names;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const TriangleMesh mesh = moved(surfaces[s], frame);
        const auto first = static_cast<std::int64_t>(data.points.size() / 3);
        for (const Vec3& vertex : mesh.vertices) add_to(data.points, vertex);
        for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
            for (const std::int32_t vertex : triangle) data.connectivity.push_back(first + vertex);
            number.push_back(static_cast<std::int64_t>(s));
        }
        names.push_back(surfaces[s].name);
    }
    data.cell_data = {VtkList::integers("wall", number)};
    data.facts.words.emplace_back("walls", names);
    return data;
}

}  // namespace

void VtkWriter::begin(const StoredWorld& world, const StateSupply& supply) {
    world_ = world;
    supply_ = supply;
    surfaces_ = surfaces_of(world);
}

void VtkWriter::contacts(const std::vector<SavedContact>& contacts) {
    contacts_ = contacts;
    has_forces_ = true;
}

void VtkWriter::frame(const State& frame, const std::vector<Link>& touches) {
    Parts parts;
    parts.grains = grain_points(frame, world_, supply_);
    if (has_forces_) parts.grains.point_data.push_back(force_array(frame, contacts_, world_));
    if (has_walls()) parts.walls = wall_triangles(surfaces_, frame);
    if (supply_.contacts)
        parts.contacts = has_forces_
                             ? contact_lines(frame, contacts_.value_or(std::vector<SavedContact>()), world_)
                             : contact_lines(frame, touches, world_);
    write(frame, std::move(parts));
    contacts_.reset();
    ++frames_;
}

}  // namespace grainreel

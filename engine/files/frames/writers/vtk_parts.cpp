#include "engine/files/frames/writers/vtk_parts.hpp"

#include <limits>

namespace grainreel {

namespace {

void add_to(std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x(), v.y(), v.z()});
}

}  // namespace

VtkPolyData vtk_grains(const State& frame, const StoredWorld& world, const StateSupply& supply) {
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

VtkList vtk_forces(const State& frame, const std::optional<std::vector<Vec3>>& forces) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> numbers;
    for (std::size_t i = 0; i < frame.size(); ++i)
        add_to(numbers, forces ? (*forces)[i] : Vec3(none, none, none));
    return VtkList::doubles("force", numbers, 3);
}

VtkPolyData vtk_walls(const std::vector<WorldSurface>& surfaces, const State& frame) {
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

}  // namespace grainreel

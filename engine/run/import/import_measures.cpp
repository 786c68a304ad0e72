#include "engine/run/import/import_measures.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/mathematics.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/files/foreign/names.hpp"
#include "engine/measure/bed/bed_observers.hpp"
#include "engine/measure/drive_observers.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observers.hpp"
#include "engine/measure/segregation/segregation_observers.hpp"
#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/reach.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/drive_motion.hpp"

namespace grainreel {

namespace {

class KineticEnergy final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"kinetic_J", "kinetic energy", Dimension::energy}}, "J", "of all grains: translation"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.push_back(kinetic_energy(m.grains).translation);
    }
};

class EnergyOfSpins final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"rotational_J", "energy of rotation", Dimension::energy}}, "J", "of all grains: spin"}};
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        row.push_back(kinetic_energy(m.grains).rotation);
    }
};

// The observers that only need a state made from a frame. Elastic energy and all that follows from it are
// left out, because the stiffness of another program's contacts is not known.
std::vector<ObserverEntry> entries(const StateSupply& supply, bool weighed) {
    std::vector<ObserverEntry> all{
        entry_of<observers::Times>(),         entry_of<observers::CentreOfMass>(),
        entry_of<observers::SpeciesPlaces>(), entry_of<observers::HeightDifference>(),
        entry_of<observers::BigAboveSmall>(), entry_of<observers::BigInQuarters>(),
        entry_of<observers::Mixing>()};
    if (supply.contacts) {
        all.push_back(entry_of<observers::ContactNumber>());
        all.push_back(entry_of<observers::ContactFabric>());
    }
    if (weighed && supply.velocities) all.push_back(entry_of<KineticEnergy>());
    if (weighed && supply.spins) all.push_back(entry_of<EnergyOfSpins>());
    all.push_back(entry_of<observers::FloorPosition>());
    return all;
}

std::int32_t row_of(const State& frame, std::int32_t id) {
    const std::optional<std::size_t> row = frame.row_of(id);
    return row ? static_cast<std::int32_t>(*row) : -1;
}

void show(const State& frame, const std::vector<Link>& touches,
          const std::function<void(const ContactView&)>& see) {
    for (const Link& touch : touches) {
        ContactView view{};
        view.first = row_of(frame, touch.first);
        view.second = touch.second < 0 ? touch.second : row_of(frame, touch.second);
        if (view.first < 0 || (touch.second >= 0 && view.second < 0)) continue;
        const auto first = static_cast<std::size_t>(view.first);
        view.glued = view.triangle = -1;
        view.normal_force = touch.force;
        view.smaller_radius = frame.radius[first];
        view.normal = Vec3(0, 0, -1);
        view.tangential = view.torque_on_first = view.torque_on_second = Vec3(0, 0, 0);
        view.point = frame.position[first];
        if (touch.second >= 0) {
            const auto second = static_cast<std::size_t>(view.second);
            const Vec3 between = frame.position[second] - frame.position[first];
            const double distance = between.norm();
            if (!(distance > 0)) continue;
            view.normal = between / distance;
            view.overlap = frame.radius[first] + frame.radius[second] - distance;
            view.smaller_radius = std::min(frame.radius[first], frame.radius[second]);
            view.point += view.normal * frame.radius[first];
        }
        see(view);
    }
}

// The scene as a plan takes it, though nothing of it is computed. A plan would read the file of its start,
// and there is none. It would also refuse walls that pass through grains within a step, but the files' walls
// have moved already, and files that number their frames 1, 2, 3 seem to have the time between frames as
// their step.
Scene as_planned(Scene scene) {
    constexpr double share = 0.05;  // of the smallest grain; check_rims() takes twice as much
    if (scene.start.method == Start::Method::file) scene.start = Start();
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species) smallest = std::min(smallest, species.diameter.smallest);
    const double speed = fastest_own_speed(scene);
    if (scene.run.step && speed * *scene.run.step > share * smallest)
        scene.run.step = share * smallest / speed;
    return scene;
}

}  // namespace

Grains grains_of(const State& frame, const Scene& scene) {
    Grains grains;
    grains.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto species = static_cast<std::size_t>(frame.species[i]);
        double density = scene.species[species].density;
        if (!frame.mass.empty())
            density = frame.mass[i] / (4.0 / 3 * std::numbers::pi * math::cube(frame.radius[i]));
        grains.add(frame.id[i], frame.species[i], frame.position[i], frame.radius[i], density);
        grains.motion[i].velocity = frame.velocity[i];
        grains.motion[i].spin = frame.spin[i];
    }
    return grains;
}

struct ImportMeasures::Impl {
    Impl(const Scene& scene_in, const Clock& clock_in, const StateSupply& supply, bool weighed)
        : scene(scene_in),
          clock(clock_in),
          plan(make_plan(as_planned(scene))),
          observers(entries(supply, weighed), scene, plan),
          faces(faces_of(scene)) {}

    const Scene scene;
    const Clock clock;
    const Plan plan;
    Observers observers;
    const std::vector<Face> faces;
    const Traffic traffic{};
};

ImportMeasures::ImportMeasures(const Scene& scene, const Clock& clock, const StateSupply& supply,
                               bool weighed)
    : impl_(std::make_unique<Impl>(scene, clock, supply, weighed)) {}

ImportMeasures::~ImportMeasures() = default;

const std::vector<std::string>& ImportMeasures::names() const {
    return impl_->observers.names();
}

Measures ImportMeasures::row(const State& frame, const std::vector<Link>& touches) {
    const Impl& m = *impl_;
    const Grains grains = grains_of(frame, m.scene);
    const double depth = m.scene.container.periodic_depth ? m.scene.container.depth : 0;
    const ObservedState moment{.scene = m.scene,
                               .clock = m.clock,
                               .grains = grains,
                               .step = frame.step,
                               .gravity = m.scene.gravity,
                               .period = depth,
                               .pose = DriveMotion(m.scene.drive, m.clock).at(frame.step),
                               .start_energy = 0,
                               .traffic = m.traffic,
                               .faces = m.faces};
    return impl_->observers.look(moment, [&](const auto& see) { show(frame, touches, see); });
}

namespace {

// The column with a meaning in the table of a wall's triangles at its first moment.
std::optional<std::size_t> column_of(const std::string& meaning, const MovingWall& wall) {
    if (wall.cells.empty()) return std::nullopt;
    return column_for(meaning, wall.cells.front(), {}, wall.name);
}

Vec3 middle_of(const TriangleMesh& mesh, std::size_t triangle) {
    Vec3 sum(0, 0, 0);
    for (const std::int32_t corner : mesh.triangles[triangle]) sum += mesh.vertices[corner];
    return sum / 3;
}

// For each triangle of the scene's mesh (`to`), its number in the file (`from`). When the scene's mesh was
// mended, some triangles were removed, the others kept their order, and corners moved by at most 1e-5 of the
// extent.
std::vector<std::size_t> origins(const TriangleMesh& from, const TriangleMesh& to) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (const Vec3& vertex : from.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
    const double near = 2e-5 * (high - low).maxCoeff();
    std::vector<std::size_t> all;
    std::size_t at = 0;
    for (std::size_t t = 0; t < to.triangles.size(); ++t) {
        const Vec3 middle = middle_of(to, t);
        while (at < from.triangles.size() && (middle_of(from, at) - middle).norm() > near) ++at;
        all.push_back(at++);
    }
    return all;
}

}  // namespace

struct ImportWear::Impl {
    struct Wall {
        std::optional<std::size_t> pressure, wear;  // numbers of these columns in its table
        std::vector<std::size_t> origin;  // for each triangle of the scene's mesh: its number in the file
    };

    Impl(const Scene& scene, const ForeignArchive& from) : archive(from) {
        const std::vector<std::string> names = face_names(scene);
        const std::size_t first = scene.meshes.size() - archive.walls().size();
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
            const Surface& surface = *scene.meshes[m].surface;
            add_fields(names.at(names.size() - scene.meshes.size() + m), scene.meshes[m].name, surface);
            Wall& wall = walls.emplace_back();
            wall.origin.resize(static_cast<std::size_t>(surface.size()));
            if (m < first) continue;
            const MovingWall& written = archive.walls()[m - first];
            wall.pressure = column_of("pressure", written);
            wall.wear = column_of("wear", written);
            wall.origin = origins(written.shape, surface.mesh());
        }
        first_wall = first;
    }

    void add_fields(const std::string& name, const std::string& label, const Surface& surface) {
        MeasuredAxis axis{"triangle_of_" + name, "1", "triangle of the mesh, as trajectory.nc has them", {}};
        for (std::int32_t t = 0; t < surface.size(); ++t) axis.at.push_back(t);
        set.axes.push_back(axis);
        set.fields.push_back({pressure_field(name),
                              "pressure on " + label,
                              "Pa",
                              "mean normal stress, as the walls' file has it",
                              {axis.name}});
        set.fields.push_back(
            {wear_field(name), "wear of " + label, "J m-2", "as the walls' file has it", {axis.name}});
    }

    std::vector<double> values(std::size_t moment, std::size_t mesh, std::optional<std::size_t> column,
                               double unit) const {
        const Wall& wall = walls[mesh];
        std::vector<double> all(wall.origin.size(), kUnknown);
        const RawTable* cells = column ? archive.wall_cells(moment, mesh - first_wall) : nullptr;
        if (cells == nullptr || *column >= cells->columns.size()) return all;
        for (std::size_t t = 0; t < all.size(); ++t)
            if (wall.origin[t] < cells->rows) all[t] = unit * cells->columns[*column].values[wall.origin[t]];
        return all;
    }

    const ForeignArchive& archive;
    std::vector<Wall> walls;
    std::size_t first_wall = 0;
    FieldSet set;
    std::optional<FieldsWriter> file;
    double last = 0;  // s, the end of the last record
};

bool ImportWear::known(const ForeignArchive& archive) {
    for (const MovingWall& wall : archive.walls())
        if (column_of("pressure", wall) || column_of("wear", wall)) return true;
    return false;
}

ImportWear::ImportWear(const std::filesystem::path& file, const Scene& scene, const ForeignArchive& archive,
                       const std::string& program_version)
    : impl_(std::make_unique<Impl>(scene, archive)) {
    impl_->file.emplace(file, std::vector<const FieldSet*>{&impl_->set}, archive.world().title,
                        program_version);
    impl_->last = archive.moments().front().time;
}

ImportWear::~ImportWear() = default;

void ImportWear::write(std::size_t moment) {
    Impl& to = *impl_;
    FieldValues values;
    const double stress = to.archive.units().pressure();
    for (std::size_t m = 0; m < to.walls.size(); ++m) {
        values.push_back(to.values(moment, m, to.walls[m].pressure, stress));
        values.push_back(to.values(moment, m, to.walls[m].wear, 1));
    }
    const double now = to.archive.moments().at(moment).time;
    to.file->write(to.last, now, {values});
    to.last = now;
}

std::vector<std::string> ImportWear::news() const {
    const auto some = [&](auto member) {
        for (const Impl::Wall& wall : impl_->walls)
            if (wall.*member) return true;
        return false;
    };
    const bool pressure = some(&Impl::Wall::pressure), wear = some(&Impl::Wall::wear);
    return {fmt::format("{}: its walls say {} of their triangles; --set film.walls.colour={} shows {}{}",
                        impl_->archive.path().string(),
                        pressure && wear ? "stress and wear"
                        : pressure       ? "stress"
                                         : "wear",
                        pressure ? "pressure" : "wear", pressure && wear ? "one of them" : "it",
                        wear ? "; wear is taken in J/m2, which depends on the constant of its model" : "")};
}

}  // namespace grainreel

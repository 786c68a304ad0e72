#include "render/run/run_files.hpp"

#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

std::vector<std::string> species_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const Species& species : scene.species) names.push_back(species.name);
    return names;
}

TrajectoryInfo trajectory_info(const Scene& scene, const Plan& plan, const std::string& version) {
    TrajectoryInfo info;
    info.title = scene.title;
    info.program_version = version;
    info.species = species_names(scene);
    info.capacity = static_cast<std::size_t>(plan.capacity);
    info.traffic = plan.traffic;
    for (const FreeWall& wall : scene.walls) info.planes.push_back(wall.name);
    info.orientation = scene.keeps_orientations();
    info.cell_origin = extent_of(scene).low;
    if (scene.container.periodic_depth) info.periodic_length.x() = scene.container.depth;
    return info;
}

}  // namespace

RunFiles::RunFiles(const std::filesystem::path& folder, const Scene& scene, const Plan& plan,
                   const Simulation& simulation, const std::string& program_version)
    : clock_(plan.clock),
      field_times_(plan.fields),
      measures_(folder / "measures.csv", simulation.measured()),
      departed_(scene) {
    if (plan.opens && !scene.container.tray) outflow_.emplace(folder / "outflow.csv");
    if (needs_measures(scene.film.shows)) table_ = std::make_shared<MeasureTable>(measures_.columns());
    if (const auto sets = simulation.field_sets(); !sets.empty())
        fields_.emplace(folder / "fields.nc", sets, scene.title, program_version);
    if (plan.trajectory_every == 0) return;
    trajectory_.emplace(folder / "trajectory.nc", trajectory_info(scene, plan, program_version));
    if (scene.output.contacts) contacts_.emplace(folder / "contacts.nc", scene.title, program_version);
}

void RunFiles::add_frame(const Frame& frame, const Simulation& simulation) {
    const std::int64_t index = trajectory_->frames();
    trajectory_->write(frame);
    if (contacts_) contacts_->write(index, simulation.contacts());
}

void RunFiles::add_fields(const Simulation& simulation) {
    const std::int64_t end = simulation.step();
    fields_->write(clock_.time(field_times_.begin_of_record(end)), clock_.time(end), simulation.fields());
}

void RunFiles::add_departures(Simulation& simulation) {
    if (!outflow_) return;
    const std::vector<Departure> gone = simulation.take_departures();
    for (const Departure& one : gone) departed_.add(clock_.time(one.step), one.species, one.radius);
    outflow_->write(gone, clock_);
}

std::optional<FlowedOut> RunFiles::flowed_out(double time) const {
    return outflow_ ? std::optional(departed_.until(time)) : std::nullopt;
}

std::optional<std::int64_t> RunFiles::outflow_rows() const {
    return outflow_ ? std::optional(outflow_->rows()) : std::nullopt;
}

void RunFiles::add_measures(const Measures& measures) {
    measures_.write(measures);
    if (table_) table_->add(measures.values());
    if (!first_) first_ = measures;
    last_ = measures;
}

}  // namespace grainreel

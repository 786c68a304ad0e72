#include "render/draw/marks/velocity_field.hpp"

#include <cmath>

#include "engine/scene/bed.hpp"
#include "engine/scene/drive/drive_schedule.hpp"

namespace grainreel {
namespace {

constexpr int least_grains = 3;  // fewer are no mean

// Hz: one over how long the drive's last period was.
double periods_a_second(const Scene& scene, const Frame& frame) {
    if (!scene.drive.changes()) return scene.drive.frequency;
    const DriveSchedule schedule(scene.drive);
    return 1 / (schedule.times().time(frame.cycles) - schedule.times().time(frame.cycles - 1));
}

}  // namespace

double field_cell_size(const Scene& scene) {
    return extent_of(scene).size().y() / scene.film.shows.arrows.across;
}

std::vector<FieldCell> velocity_field(const Scene& scene, const Frame& frame) {
    const FilmArrows& arrows = scene.film.shows.arrows;
    if (arrows.period && frame.displacement.size() != frame.size()) return {};
    const double side = field_cell_size(scene);
    const Extent extent = extent_of(scene);
    const int across = arrows.across, upward = static_cast<int>(std::ceil(extent.size().z() / side));
    std::vector<FieldCell> cells(static_cast<std::size_t>(across) * upward);
    std::vector<double> mass(cells.size(), 0);
    const double frequency = arrows.period ? periods_a_second(scene, frame) : 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 at = frame.position[i] - frame.container().place - extent.low;
        const int column = static_cast<int>(std::floor(at.y() / side)),
                  row = static_cast<int>(std::floor(at.z() / side));
        if (column < 0 || column >= across || row < 0 || row >= upward) continue;
        if (arrows.period && frame.displacement[i].hasNaN()) continue;  // it was not there a period before
        const std::size_t c = static_cast<std::size_t>(row) * across + column;
        const double m = scene.species[static_cast<std::size_t>(frame.species[i])].density *
                         std::pow(frame.radius[i], 3);  // up to a factor
        cells[c].velocity +=
            m * (arrows.period ? Vec3(frame.displacement[i] * frequency) : frame.velocity[i]);
        cells[c].centre_of_mass += m * frame.position[i];
        mass[c] += m;
        ++cells[c].grains;
    }
    std::vector<FieldCell> filled;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        FieldCell cell = cells[c];
        if (cell.grains < least_grains) continue;
        cell.velocity /= mass[c];
        cell.centre_of_mass /= mass[c];
        const auto column = static_cast<double>(c % across), row = static_cast<double>(c / across);
        cell.middle = extent.low + frame.container().place;
        cell.middle += Vec3(0.5 * extent.size().x(), (column + 0.5) * side, (row + 0.5) * side);
        filled.push_back(cell);
    }
    return filled;
}

}  // namespace grainreel

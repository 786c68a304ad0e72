#include "engine/measure/walls/wall_faces.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/output.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/drive_motion.hpp"

namespace grainreel {

namespace {

constexpr int kMostSlices = 100;

double largest_radius(const Scene& scene) {
    double largest = 0;
    for (const Species& species : scene.species) largest = std::max(largest, 0.5 * species.diameter.largest);
    return largest;
}

// Number of slices of height. Each is about two diameters of the largest grain high.
int slices_of(const Scene& scene) {
    if (scene.container.shape == Container::Shape::none || scene.container.shape == Container::Shape::mesh)
        return 0;
    if (scene.container.turn) return 0;  // none of its walls stays upright
    const double slices = scene.container.height / (4 * largest_radius(scene));
    return static_cast<int>(std::clamp(std::round(slices), 1.0, double{kMostSlices}));
}

}  // namespace

double area_between(const Container& c, const std::string& face, double low, double high) {
    const bool wedge = c.shape == Container::Shape::wedge && c.half_angle > 0;
    const double edge = wedge ? c.slant_height : 0;
    const auto part = [&](double from, double to) {
        return std::max(0.0, std::min(high, to) - std::max(low, from));
    };
    if (face == "wall") return 2 * std::numbers::pi * c.half_width * part(0, c.height);
    if (face.ends_with(" slant")) return c.depth * part(0, edge) / math::cos(c.half_angle);
    if (face.ends_with(" wall")) return c.depth * part(edge, c.height);
    if (face != "front" && face != "back") return 0;
    const double slanted = part(0, edge), middle = 0.5 * (std::max(low, 0.0) + std::min(high, edge));
    const double half = wedge ? c.half_width - (edge - middle) * math::tan(c.half_angle) : 0;
    return 2 * (slanted * half + part(edge, c.height) * c.half_width);
}

WallScale wall_scale(const Scene& scene, const Plan& plan) {
    double stiffest = 0;
    for (const std::vector<PairPlan>* walls : {&plan.wall, &plan.glued, &plan.mesh})
        for (const PairPlan& wall : *walls)
            stiffest = std::max({stiffest, wall.loading_stiffness, wall.unloading_stiffness});
    WallScale scale;
    scale.force = std::ldexp(math::power_of_two_up_to(stiffest * largest_radius(scene)), -48);
    scale.length = math::power_of_two_from(extent_of(scene).size().norm());
    scale.slices = slices_of(scene);
    scale.slice = scale.slices > 0 ? scene.container.height / scale.slices : 0;
    scale.period = period_of_depth(scene.container);
    return scale;
}

PressureProfile::PressureProfile(const Scene& scene) {
    const int slices = slices_of(scene);
    const double slice = slices > 0 ? scene.container.height / slices : 0;
    MeasuredAxis height{"height", "m", "above the floor at rest, in the frame of the container", {}};
    for (int s = 0; s < slices; ++s) height.at.push_back((s + 0.5) * slice);
    fields_.axes.push_back(height);
    const std::vector<Face> faces = container_faces(scene.container, scene.drive);
    const std::vector<std::string> names = face_names(scene);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::vector<double> area;
        for (int s = 0; s < slices; ++s)
            area.push_back(area_between(scene.container, faces[f].name, s * slice, (s + 1) * slice));
        if (std::all_of(area.begin(), area.end(), [](double a) { return a == 0; })) continue;
        fields_.fields.push_back({"pressure_" + names[f],
                                  "pressure on " + faces[f].name,
                                  "Pa",
                                  "mean normal force of all steps of the record, divided by the area",
                                  {"height"}});
        faces_.push_back(f);
        area_.push_back(std::move(area));
    }
}

FieldValues PressureProfile::pressures(const std::vector<double>& normal) const {
    FieldValues values;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
        std::vector<double>& profile = values.emplace_back();
        for (std::size_t s = 0; s < area_[k].size(); ++s)
            profile.push_back(area_[k][s] > 0 ? normal[faces_[k] * area_[k].size() + s] / area_[k][s]
                                              : kUnknown);
    }
    return values;
}

namespace {

constexpr double kLooksAPeriod = 128, kLooksARow = 64;

// Whether the velocity or the spin of a body changes.
bool is_unsteady(const Body& body, const Drive& drive) {
    const bool ramps =
        body.turn && (body.turn->from > 0 || body.turn->over > 0 || std::isfinite(body.turn->until));
    return (body.driven && drive.present) || body.path || ramps;
}

// The difference of two sums, in counts. Whole numbers are subtracted, so that no digits are lost late in a
// run.
using Three = std::array<WideInt, 3>;
Vec3 sum(const Three& then, const Three& now, double felt, const Three& last_then, const Three& last_now) {
    Vec3 counts;
    for (int a = 0; a < 3; ++a)
        counts[a] =
            static_cast<double>(now[a] - then[a]) + felt * static_cast<double>(last_now[a] - last_then[a]);
    return counts;
}

std::vector<double> angles_at(const std::vector<Body>& bodies, double time) {
    std::vector<double> angles;
    for (const Body& body : bodies) angles.push_back(body.turn ? body.turn->angle_at(time) : 0);
    return angles;
}

}  // namespace

WallSum sum_between(const FaceSums& then, const FaceSums& now, const WallSums& sums) {
    const WallScale& unit = sums.scale;
    return {sum(then.force, now.force, sums.felt, then.last_force, now.last_force) * unit.force,
            sum(then.moment, now.moment, sums.felt, then.last_moment, now.last_moment) * unit.force *
                unit.length};
}

WallWork::WallWork(const Scene& scene, const Plan& plan)
    : walls_(wall_bodies(scene)), bodies_(bodies_of(scene)) {
    bool unsteady = false;
    for (const WallBody& wall : walls_)
        if (!wall.fixed) any_ = true, unsteady |= is_unsteady(bodies_[wall.body], scene.drive);
    if (!unsteady) return;
    double every = plan.measures_every / kLooksARow;
    if (const auto period = static_cast<double>(plan.clock.steps_per_period); period > 0)
        every = every > 0 ? std::min(every, period / kLooksAPeriod) : period / kLooksAPeriod;
    every_ = std::max<std::int64_t>(1, std::llround(every));
}

std::int64_t WallWork::gathers_after(std::int64_t step) const {
    return every_ > 0 ? (step + every_) / every_ * every_ : Observer::kNever;
}

void WallWork::start(const ObservedState& m) {
    if (!any_) return;
    work_.assign(walls_.size(), 0);
    step_ = m.step;
    sums_ = m.wall_sums->faces;
    poses_ = poses_of(bodies_, m.pose);
    turned_ = angles_at(bodies_, m.pose.time);
}

void WallWork::gather(const ObservedState& m) {
    if (!any_ || m.step <= step_) return;
    std::vector<double> work = until(m);
    start(m);
    work_ = std::move(work);
}

std::vector<double> WallWork::until(const ObservedState& m) const {
    std::vector<double> work = work_;
    if (!any_ || m.step <= step_) return work;
    const std::vector<double> turned = angles_at(bodies_, m.pose.time);
    const double length = m.clock.step, time = length * static_cast<double>(m.step - step_);
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const WallBody& wall = walls_[w];
        if (wall.fixed) continue;
        const BodyPose now = bodies_[wall.body].at(m.pose);
        const Vec3 way = now.moved(wall.point) - poses_[wall.body].moved(wall.point);
        const Vec3 spin = wall.turns ? Vec3((turned[wall.body] - turned_[wall.body]) / time * wall.axis)
                                     : Vec3(0.5 * (now.spin + poses_[wall.body].spin));
        const WallSum on_wall = sum_between(sums_[w], m.wall_sums->faces[w], *m.wall_sums);
        work[w] -= length * (on_wall.force.dot(way) / time + on_wall.moment.dot(spin));
    }
    return work;
}

void WallWork::save(std::ostream& out) const {
    if (!any_) return;
    const Writing each{out};
    each(step_), each(sums_), each(work_);
}

void WallWork::load(const ObservedState& m, Bytes& in) {
    if (!any_) return;
    const Reading each{in};
    each(step_), each(sums_), each(work_);
    const bool finite = std::all_of(work_.begin(), work_.end(), [](double w) { return std::isfinite(w); });
    if (step_ < 0 || step_ > m.step || sums_.size() != walls_.size() || work_.size() != walls_.size() ||
        !are_sound(sums_) || !finite)
        return in.fail();
    const DrivePose drive = DriveMotion(m.scene.drive, m.clock).at(step_);
    poses_ = poses_of(bodies_, drive);
    turned_ = angles_at(bodies_, drive.time);
}

}  // namespace grainreel

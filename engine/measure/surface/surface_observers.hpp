// Observers of the bed's surface: its waves and heaps (BedSurface), and its dynamic angle of repose in a drum
// that turns (Drum), with the formulas for drums. The surface is that of surface.hpp, so grains in flight do
// not count.
//
// In a drum the bed is seen along the axis. The angle of repose is that between the horizontal and the
// least-squares line through the middle third of the surface, because away from the walls the surface is
// straight as long as the bed rolls or cascades (Yamane, Nakagawa, Altobelli, Tanaka and Tsuji 1998, Phys.
// Fluids 10, 1419; Orpe and Khakhar 2001, Phys. Rev. E 64, 031302).
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <span>

#include "engine/base/vector.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/motion.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Three perpendicular unit vectors. `along` is the axis. `across` is level and points to the side on which
// the drum carries the bed up. `up` is perpendicular to both.
struct DrumAxes {
    Vec3 along, across, up;
};
// Empty if the axis is upright (within 30 degrees of gravity) or there is no gravity.
std::optional<DrumAxes> drum_axes(const BodyTurn& turn, const Vec3& gravity);

// The angle (rad) is above 0 if the bed is highest on the side where the drum carries it up. `diameter` (m)
// is the mean diameter of the grains. NaN with fewer than 20 grains, or if the middle third has fewer than
// three bins. Bins are about two diameters wide.
double angle_of_repose(std::span<const Place> grains, const DrumAxes& axes, double diameter);

// The Froude number w^2 R / g. Below 1e-4 a bed slips or slumps, up to about 0.1 it rolls and cascades, above
// that it cataracts, and at 1 it goes round with the drum (Mellmann 2001, Powder Technol. 118, 251).
double froude_number(double rate, double radius, double gravity);

}  // namespace grainreel

namespace grainreel::observers {

// Observer of the shape of the bed's surface: waves across the container, and heaps.
class BedSurface final : public Observer {
  public:
    static constexpr const char* instrument = "surface";

    static std::vector<ColumnGroup> columns(const Scene&) {
        constexpr Dimension length = Dimension::length;
        return {
            {{{"surface_wavelength_m", "wavelength of the surface", length}},
             "m",
             "of the wave across the container of which the surface has most (whole and half numbers of "
             "waves)"},
            {{{"surface_wave", "share of the largest wave"}},
             "1",
             "share of that wave in the variance of the surface's height"},
            {{{"surface_rms_m", "roughness of the surface", length}},
             "m",
             "root mean square deviation of the surface from its mean height"},
            {{{"surface_half", "share of waves at f/2"}, {"surface_quarter", "share of waves at f/4"}},
             "1",
             "share of the surface's shape, over eight periods at this phase, that is inverted after each "
             "period, and after two; by chance 1/8 and 1/4"},
            {{{"mound_height_m", "height of the mound", length}},
             "m",
             "mean height of the surface's middle third less that of its two outer sixths"},
            {{{"mound_slope", "slope of the mound"}},
             "1",
             "tangent of the mean rise from both walls to the middle"},
            {{{"surface_tilt", "tilt of the surface"}}, "1", "tangent of the rise from left to right"}};
    }
    static std::string why_empty(const Scene& scene, const std::string& column) {
        const SurfaceAxes frame = surface_frame(scene);
        if (!(frame.right > frame.left)) return "the scene has no container with a surface of grains in it";
        const bool of_drive = column == "surface_half" || column == "surface_quarter";
        return of_drive && !scene.drive.present ? "it compares periods of the drive, and nothing is driven"
                                                : "";
    }
    BedSurface(const Scene& scene, const Plan& plan) : rows_(plan), frame_(surface_frame(scene)) {}

    std::int64_t gathers_after(std::int64_t step) const override { return rows_.after(step); }
    void start(const ObservedState& m) override { gather(m); }
    // Keeps the surfaces of all rows in the last eight periods.
    void gather(const ObservedState& m) override {
        if (m.clock.steps_per_period == 0 || !has_surface(m)) return;
        earlier_.push_back({m.step, surface_at(m).height});
        while (periods_since(m, earlier_.front()) >= kComparedPeriods - kHair) earlier_.pop_front();
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!has_surface(m)) return add_no_values(row, 8);
        const BedOutline surface = surface_at(m);
        if (!spectrum_) spectrum_.emplace(surface.height.size());
        const DominantWave wave = spectrum_->dominant(surface.height, surface.width());
        const Subharmonics shares = compare_with_earlier(m, surface.height);
        const Mound mound = mound_of(surface);
        row.insert(row.end(), {wave.wavelength, wave.share, std::sqrt(variance_of(surface.height)),
                               shares.half, shares.quarter, mound.height, mound.slope, mound.tilt});
    }
    void save(std::ostream& out) const override {
        write_value(out, static_cast<std::uint64_t>(earlier_.size()));
        for (const Earlier& earlier : earlier_) {
            write_value(out, earlier.step);
            write_vector(out, earlier.height);
        }
    }
    void load(const ObservedState& m, Bytes& in) override {
        std::uint64_t count = 0;
        read_value(in, count);
        std::int64_t last = -1;
        for (std::uint64_t i = 0; i < count && !in.failed(); ++i) {
            Earlier& earlier = earlier_.emplace_back();
            read_value(in, earlier.step);
            read_vector(in, earlier.height);
            const bool finite = std::all_of(earlier.height.begin(), earlier.height.end(),
                                            [](double h) { return std::isfinite(h); });
            if (earlier.step <= last || earlier.step > m.step || !finite ||
                earlier.height.size() != bins_across(frame_))
                in.fail();
            last = earlier.step;
        }
    }

  private:
    struct Earlier {
        std::int64_t step = 0;
        std::vector<double> height;  // m
    };

    // Tolerance as a share of a period. Rows are at whole steps, so they may miss a whole period by a little.
    static constexpr double kHair = 1e-3;

    static double periods_since(const ObservedState& m, const Earlier& earlier) {
        return m.clock.cycles(m.step) - m.clock.cycles(earlier.step);
    }
    bool has_surface(const ObservedState& m) const {
        return frame_.right > frame_.left && m.grains.size() > 0;
    }
    BedOutline surface_at(const ObservedState& m) const {
        SurfaceAxes frame = frame_;
        frame.left += m.pose.offset.y(), frame.right += m.pose.offset.y();
        frame.back += m.pose.offset.x(), frame.front += m.pose.offset.x();
        return surface_of(m.grains.place, frame);
    }
    // NaN until enough periods have been seen at this phase, and if rows are not whole periods apart.
    Subharmonics compare_with_earlier(const ObservedState& m, const std::vector<double>& height) const {
        if (m.clock.steps_per_period == 0) return {kUnknown, kUnknown};
        std::vector<const std::vector<double>*> same_phase;
        for (const Earlier& earlier : earlier_) {
            const double periods = periods_since(m, earlier);
            if (earlier.step < m.step && periods < kComparedPeriods - kHair &&
                std::abs(periods - std::round(periods)) < kHair)
                same_phase.push_back(&earlier.height);
        }
        same_phase.push_back(&height);
        if (same_phase.size() != kComparedPeriods) return {kUnknown, kUnknown};
        return subharmonics_of(same_phase);
    }

    const Rows rows_;
    const SurfaceAxes frame_;
    std::optional<Spectrum> spectrum_;
    std::deque<Earlier> earlier_;  // by rising step
};

// Observer of a drum, or of another body that turns the grains: its angle of turn, and the bed's surface in
// it.
class Drum final : public Observer {
  public:
    static constexpr const char* instrument = "drum";

    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"revolutions", "revolutions"}},
             "1",
             "of what turns since it began: of the container, or of the mesh that is the container, or of "
             "the "
             "first mesh that turns; NaN without one. Whatever else is measured can be drawn against it"},
            {{{"repose_angle_degree", "dynamic angle of repose", Dimension::degrees}},
             "degrees",
             "of the bed's surface against the horizontal, seen along the axis: of the line of least squares "
             "through the middle third of it, above 0 where the drum carries the bed up (Yamane et al. "
             "1998); "
             "NaN where the axis stands"},
            {{{"froude_number", "Froude number"}},
             "1",
             "square of the present rate times the drum's radius, divided by gravity; below 1e-4 the bed "
             "slumps, then it rolls and cascades, from about 0.1 on it cataracts, and at 1 it goes round "
             "with the drum "
             "(Mellmann 2001)"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) {
        return turning_body(scene) ? "" : "nothing turns in the scene";
    }
    Drum(const Scene& scene, const Plan&) : drum_(turning_body(scene)), diameter_(mean_diameter(scene)) {}

    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!drum_) return add_no_values(row, 3);
        const BodyTurn& turn = drum_->turn;
        const auto axes = drum_axes(turn, m.gravity);
        const double angle = axes ? angle_of_repose(m.grains.place, *axes, diameter_) : kUnknown;
        row.insert(row.end(), {std::abs(turn.angle_at(m.pose.time)) / (2 * std::numbers::pi),
                               angle * 180 / std::numbers::pi,
                               froude_number(turn.rate_at(m.pose.time), drum_->radius, m.gravity.norm())});
    }

  private:
    const std::optional<TurningBody> drum_;
    const double diameter_;  // m
};

}  // namespace grainreel::observers

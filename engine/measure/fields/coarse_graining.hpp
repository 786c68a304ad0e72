// Coarse-graining makes fields from the grains and contacts at many moments (Goldhirsch 2010, Granul. Matter
// 12, 239), and profiles of such fields. W is the kernel, sums go over grains i, and <> is the mean over
// moments:
//
//   density            rho = < sum m_i W(r - r_i) >; for the solid fraction, with volumes in place of masses
//   velocity           V = < sum m_i v_i W > / < sum m_i W >
//   granular temperature  T = < sum m_i |v_i - V_p|^2 W > / (3 < sum m_i W >)
//   kinetic stress     < sum m_i (v_i - V_p) x (v_i - V_p) W >
//   contact stress     < sum over contacts  f x b  integral over s from 0 to 1 of W(r - r_i - s b) >
//
// V_p is the velocity field at the same place and phase of the drive, because motion that all grains share in
// each period is no heat. f is the force on the second body, and b is the branch from the first grain's
// centre to the second's, or at a wall to the point of contact (Weinhart, Thornton, Luding & Bokhove 2012,
// Granul. Matter 14, 289). Pressure counts as positive stress; the first index belongs to force or momentum.
//
// W has the width that the fields ask for, but the kernel W_i of a grain is never narrower than the grain's
// radius (kernel_width() in field_grid.hpp): otherwise a large grain has a solid fraction above 1. Where two
// grains in contact have kernels of different widths, Goldhirsch's line becomes a line along which the kernel
// W_s changes its width w_s evenly, and b is replaced by the velocity that the kernel's parts then have:
//
//   contact stress     < sum over contacts  f x integral over s of W_s (b + (r - r_i - s b) d(ln w_s)/ds) >
//
// By continuity the divergence of the integral is W_i - W_j, so the balance of momentum holds as with one
// width. Integrated over all space, it gives b.
//
// Density and solid fraction take the kernel that is clipped at the walls: it is scaled for each grain so
// that all of it lies inside, and the sum of density x inside share x cell volume is the mass of the grains.
// All other fields take the whole kernel, for which balances of mass and momentum hold.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/measure/fields/field_grid.hpp"
#include "engine/measure/fields/footprint.hpp"

namespace grainreel {

// A grain as coarse-graining sees it. Places and velocities are relative to the container if the drive moves
// it.
struct FieldGrain {
    Vec3 position;  // m
    Vec3 velocity;  // m/s
    double mass;    // kg
    double volume;  // m3
    std::int32_t species;
    double radius = 0;  // m, least width of its kernel; 0 for a point
};

// A contact of a grain with another grain or a wall.
struct FieldBranch {
    Vec3 begin;   // m, the grain's centre
    Vec3 branch;  // m, from there to the other grain's centre, or to the point of the wall that it touches
    Vec3 force;   // N, on the other body
    double radius = 0, other_radius = 0;  // m, radii of the two grains; at a wall both are that of the grain
};

// The grains and contacts of one moment.
struct FieldState {
    std::vector<FieldGrain> grains;
    std::vector<FieldBranch> contacts;
};

// One value per cell, in the grid's order.
using CellValues = std::vector<double>;

struct CoarseFields {
    CellValues density;                      // kg/m3
    std::vector<CellValues> solid_fraction;  // one per species
    std::vector<CellValues> velocity;        // m/s: x, y, z; NaN where no grain is near, and in the walls
    CellValues temperature;                  // m2/s2; NaN in the same cells
    std::vector<CellValues> kinetic_stress;  // Pa: xx, xy, xz, yy, yz, zz
    std::vector<CellValues> contact_stress;  // Pa: xx, xy, xz, yx, ... zz
};

class CoarseGraining {
  public:
    // `phases` is the number of phases of the drive that are kept apart; 1 without a drive.
    CoarseGraining(const Scene& scene, const FieldOutput& fields, int phases);
    // The same with the settings of the scene's fields.nc.
    CoarseGraining(const Scene& scene, int phases) : CoarseGraining(scene, scene.output.fields, phases) {}

    const FieldGrid& grid() const { return grid_; }
    const std::vector<double>& shares() const { return shares_; }  // share of each cell that is inside

    // Adds the state of one moment, with 0 <= phase < phases. The last bits depend on the order of grains and
    // contacts.
    void add(const FieldState& state, int phase);
    // Mean over all moments since the last clear(). All phases must have had equally many moments.
    CoarseFields mean() const;
    void clear();
    std::int64_t moments() const { return moments_; }
    std::size_t species() const { return species_; }

    // Saves and loads all sums, bit by bit. Reading fails for anything that save() cannot have written.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    void add_grain(const FieldGrain& grain, double* motion);
    void add_contact(const FieldBranch& contact);
    bool is_inside(const Vec3& place) const;

    FieldGrid grid_;
    std::vector<double> shares_;
    Footprint footprint_;
    std::size_t species_;
    std::int64_t moments_ = 0;
    std::vector<CellValues> motion_;  // one for each phase; per cell mass, momentum, and the products m v v
    CellValues solid_;                // per cell density, then the solid fractions
    CellValues contact_;              // per cell the nine products
};

// Profiles are means of a field in the (y, z) plane along one direction, as functions of the place along the
// other. These are the axes of a grid that is not resolved along x.
enum class ProfileAxis : std::size_t { across = 1, height = 2 };

// The mean of `values` over all cells at each place, weighted by `weights`. Cells without a value (NaN) are
// left out, and a place without weight gives NaN.
std::vector<double> profile_of(const CellValues& values, const CellValues& weights, const FieldGrid& grid,
                               ProfileAxis axis);

// The solid fraction of each species: volume of its grains divided by the volume inside the container.
std::vector<std::vector<double>> solid_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// The share of each species in the solid volume; NaN where there is none.
std::vector<std::vector<double>> share_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis);
// Velocity (m/s): the momentum divided by the mass of all grains at a place. `component` is 0, 1 or 2 for x,
// y or z.
std::vector<double> velocity_profile(const CoarseFields& fields, const CoarseGraining& by, ProfileAxis axis,
                                     std::size_t component);

}  // namespace grainreel

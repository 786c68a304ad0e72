// Coarse-graining: from grains and contacts at many moments to fields (Goldhirsch 2010, Granul. Matter 12,
// 239). With W the kernel, sums over grains i, and <> the mean over moments:
//
//   density            rho = < sum m_i W(r - r_i) >, of a solid fraction with the grains' volumes
//   velocity           V = < sum m_i v_i W > / < sum m_i W >
//   granular temperature  T = < sum m_i |v_i - V_p|^2 W > / (3 < sum m_i W >)
//   kinetic stress     < sum m_i (v_i - V_p) x (v_i - V_p) W >
//   contact stress     < sum over contacts  f x b  integral over s from 0 to 1 of W(r - r_i - s b) >
//
// V_p is the velocity field of the same place and phase of the drive: what all grains do together in each
// period is no heat. f is the force on the second body, b the branch from the first grain's centre to the
// second's, or at a wall to the point of contact (Weinhart, Thornton, Luding & Bokhove 2012, Granul. Matter
// 14, 289). Stresses count pressure as positive; the first index is that of force or momentum.
//
// W has the width that the fields ask for, but the kernel W_i of a grain is never narrower than the grain's
// radius (kernel_width() in field_grid.hpp): otherwise a large grain has a solid fraction above 1. Where two
// grains in contact have kernels of different widths, Goldhirsch's line becomes a line along which the kernel
// W_s changes its width w_s evenly, and in place of b stands the velocity that its parts have then:
//
//   contact stress     < sum over contacts  f x integral over s of W_s (b + (r - r_i - s b) d(ln w_s)/ds) >
//
// By continuity the divergence of the integral is W_i - W_j, so that the balance of momentum holds as it does
// with one width; and its integral over space is b.
//
// Density and solid fraction take the kernel that is clipped at the walls: it is scaled for each grain so
// that all of it lies inside, and the sum of density x inside share x cell volume is the mass of the grains.
// All else takes the whole kernel, for which balances of mass and momentum hold.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/measure/fields/field_grid.hpp"
#include "engine/measure/fields/field_state.hpp"
#include "engine/measure/fields/footprint.hpp"

namespace grainreel {

// One value a cell, in the grid's order.
using CellValues = std::vector<double>;

struct CoarseFields {
    CellValues density;                      // kg/m3
    std::vector<CellValues> solid_fraction;  // one a species
    std::vector<CellValues> velocity;        // m/s: x, y, z; NaN where no grain is near, and in the walls
    CellValues temperature;                  // m2/s2; as above
    std::vector<CellValues> kinetic_stress;  // Pa: xx, xy, xz, yy, yz, zz
    std::vector<CellValues> contact_stress;  // Pa: xx, xy, xz, yx, ... zz
};

class CoarseGraining {
  public:
    // phases: of the drive, that are kept apart; 1 without a drive.
    CoarseGraining(const Scene& scene, const FieldOutput& fields, int phases);
    // As the scene's fields.nc has them.
    CoarseGraining(const Scene& scene, int phases) : CoarseGraining(scene, scene.output.fields, phases) {}

    const FieldGrid& grid() const { return grid_; }
    const std::vector<double>& shares() const { return shares_; }  // of each cell that are inside

    // Adds a moment. 0 <= phase < phases. The order of grains and contacts decides the last bits.
    void add(const FieldState& state, int phase);
    // Mean over all moments since the last clear(). Each phase must have had as many of them as the others.
    CoarseFields mean() const;
    void clear();
    std::int64_t moments() const { return moments_; }
    std::size_t species() const { return species_; }

    // All sums, bit by bit. load() makes the reading fail where save() could not have written what is read.
    void save(std::ostream& out) const;
    void load(Bytes& in);

  private:
    void add_grain(const FieldGrain& grain, double* motion);
    void add_contact(const FieldContact& contact);
    bool is_inside(const Vec3& place) const;

    FieldGrid grid_;
    std::vector<double> shares_;
    Footprint footprint_;
    std::size_t species_;
    std::int64_t moments_ = 0;
    std::vector<CellValues> motion_;  // one a phase; in a cell mass, momentum, and the products m v v
    CellValues solid_;                // in a cell density, then the solid fractions
    CellValues contact_;              // in a cell the nine products
};

}  // namespace grainreel

// The kernels of coarse-graining: how a grain, which is a point, is spread over its surroundings.
//
// Both are radial, in two or three dimensions, and end at a cutoff. Only their shape matters here: a
// footprint (footprint.hpp) scales the values to a sum of one over the cells of its grid.
#pragma once

#include "engine/scene/field_output.hpp"

namespace grainreel {

class FieldKernel {
  public:
    // width: m, the standard deviation along one axis: exactly with Lucy's kernel, before the cutoff with the
    // Gaussian. dimensions: 2 or 3.
    FieldKernel(FieldOutput::Kernel kind, double width, int dimensions);

    double cutoff() const { return cutoff_; }  // m

    // Value at a distance r, whose square (m2) is given: 1 in the middle, 0 from the cutoff on.
    // Gaussian: exp(-r2 / 2w2), with its cutoff at 3 w (Weinhart, Hartkamp, Thornton & Luding 2013, Phys.
    // Fluids 25, 070605). Lucy (1977, Astron. J. 82, 1013): (1 + 3 q)(1 - q)^3, q = r / cutoff.
    double at(double square) const;

    // Integral of the value along a straight line, m, in closed form. `square` is the squared distance of the
    // line from the middle (m2); `from` and `to` are counted along the line from its nearest point (m).
    double along(double square, double from, double to) const;

  private:
    double lucy_integral(double square, double to) const;

    FieldOutput::Kernel kind_;
    double width_, cutoff_;  // m
};

}  // namespace grainreel

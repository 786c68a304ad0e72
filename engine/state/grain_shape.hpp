// The shape of a grain that is no sphere, as files of other programs have it: an ellipsoid, or a superquadric
// (A. H. Barr, IEEE Computer Graphics and Applications 1, 11 (1981)) as LIGGGHTS has it (A. Podlozhnyuk, S.
// Pirker, C. Kloss, Computational Particle Mechanics 4, 101 (2017), eq. 1):
// (|x/a|^around + |y/b|^around)^(along/around) + |z/c|^along = 1. Our own runs have spheres alone.
#pragma once

#include "engine/base/vector.hpp"

namespace grainreel {

struct GrainShape {
    Vec3 half = Vec3::Zero();      // m: a, b, c along the grain's own axes
    double along = 2, around = 2;  // powers ("blockiness 1 and 2"); with 2 and 2 it is an ellipsoid
};

constexpr double kMostBlockiness = 100;  // beyond it a superquadric is a box or a cylinder

// Whether a grain can have this shape: half lengths above 0, powers from 2 to kMostBlockiness.
bool is_possible(const GrainShape& shape);

// m: radius of the sphere with the same volume (A. Jaklic, A. Leonardis, F. Solina, Segmentation and Recovery
// of Superquadrics (2000), eq. 2.60).
double radius_by_volume(const GrainShape& shape);

}  // namespace grainreel

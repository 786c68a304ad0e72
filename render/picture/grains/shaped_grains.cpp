#include "render/picture/grains/shaped_grains.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

// m: radius of a sphere around the shape. A superquadric reaches into the corners of a box.
double reach(const GrainShape& shape) {
    return shape.along > 2 || shape.around > 2 ? shape.half.norm() : shape.half.maxCoeff();
}

ViewSphere ball(const Vec3& centre, double radius) {
    return {static_cast<float>(centre.x()), static_cast<float>(centre.y()), static_cast<float>(centre.z()),
            static_cast<float>(radius)};
}

ViewShape view_shape(const GrainShape& shape, const Eigen::Matrix3d& axes) {
    ViewShape seen;
    for (int own = 0; own < 3; ++own)
        for (int k = 0; k < 3; ++k) seen.to_unit[own][k] = static_cast<float>(axes(k, own) / shape.half[own]);
    seen.along = static_cast<float>(shape.along);
    seen.around = static_cast<float>(shape.around);
    return seen;
}

ViewShape shape_of_ball(double radius) {
    return view_shape({Vec3::Constant(radius)}, Eigen::Matrix3d::Identity());
}

// Adds balls along each axis on which the grain is long. Like the ball in the middle they lie within the
// grain, so that they take no light from its own surface, and they overlap. On an axis of the half length a,
// a ball at the distance x from the middle of an ellipsoid, whose shortest half length is c, touches its
// surface from inside where its radius is c root(1 - x^2 / (a^2 - c^2)). In the corners of a superquadric
// there is more room.
void add_balls(const Vec3& centre, const GrainShape& shape, const Eigen::Matrix3d& axes, Spheres& spheres) {
    constexpr double kLong = 1.2, kFarthest = 0.9;
    constexpr int kMost = 6;  // on each side
    const double least = shape.half.minCoeff();
    for (int own = 0; own < 3; ++own) {
        const double half = shape.half[own];
        if (half < kLong * least) continue;
        const double room = std::sqrt(half * half - least * least);
        const int count = std::clamp(static_cast<int>(std::ceil(room / (0.7 * least))), 1, kMost);
        for (int k = 1; k <= count; ++k) {
            const double share = kFarthest * k / count, radius = least * std::sqrt(1 - share * share);
            for (const double side : {-1.0, 1.0})
                spheres.spheres.push_back(ball(centre + side * share * room * axes.col(own), radius));
        }
    }
}

}  // namespace

void give_shapes(const View& view, const State& frame, Spheres& spheres) {
    spheres.shapes.clear();
    spheres.around.clear();
    if (frame.shape.empty()) return;
    const std::size_t drawn = spheres.spheres.size();
    spheres.around = spheres.spheres;
    Eigen::Matrix3d to_view;
    to_view << view.right.transpose(), view.up.transpose(), view.forward.transpose();
    for (std::size_t i = 0; i < drawn; ++i) {
        if (i >= frame.size()) {
            spheres.shapes.push_back(shape_of_ball(spheres.spheres[i].radius));
            continue;
        }
        const GrainShape& shape = frame.shape[i];
        const Eigen::Matrix3d axes = to_view * frame.orientation[i].toRotationMatrix();
        const Vec3 centre = view.to_view(frame.position[i]);
        spheres.shapes.push_back(view_shape(shape, axes));
        spheres.around[i].radius = static_cast<float>(reach(shape));
        spheres.spheres[i].radius = static_cast<float>(shape.half.minCoeff());
        add_balls(centre, shape, axes, spheres);
    }
}

}  // namespace grainreel

#include "render/picture/container/drawing_kit.hpp"

#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

// The sine of the angle over which a moving camera sees one look become another, to each side.
const double fade = std::sin(8 * std::numbers::pi / 180);

}  // namespace

double smooth_step(double value, double half_width) {
    const double s = std::clamp(0.5 + 0.5 * value / half_width, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

Paint faded(const Paint& paint, double share) {
    return {paint.colour, paint.alpha * share};
}

Paint blend(const Paint& one, const Paint& other, double share_of_other) {
    if (share_of_other <= 0) return one;
    if (share_of_other >= 1) return other;
    const double a = one.alpha * (1 - share_of_other), b = other.alpha * share_of_other;
    return {mix(one.colour, other.colour, b / std::max(a + b, 1e-9)), a + b};
}

double Sketch::solid(const Vec3& point, const Vec3& normal) const {
    const View& view = views_.at_rest;
    if (turned_) {
        const Vec3 at = views_.now.orthographic ? Vec3(-views_.now.forward)
                                                : Vec3((views_.now.eye - moved(point)).normalized());
        return smooth_step(-turned(normal).dot(at) - fade, fade);
    }
    if (!views_.moves) return view.faces(point, normal) ? 0 : 1;
    const Vec3 to_eye = view.orthographic ? Vec3(-view.forward) : Vec3(view.eye - point).normalized();
    // Glass by the time the eye is in the plane: there the part changes from behind the grains to before
    // them.
    return smooth_step(-normal.dot(to_eye) - fade, fade);
}

double Sketch::positive_end_is_near() const {
    const double towards = -view().forward.dot(turned(Vec3(1, 0, 0)));
    return views_.moves || turned_ ? smooth_step(towards, fade) : towards >= 0 ? 1 : 0;
}

void Sketch::dashed(Shapes& on, std::vector<Vec3> points, bool closed, double width,
                    const Paint& paint) const {
    if (closed) points.push_back(points.front());
    const std::vector<Pixel> path = project(points);
    const double dash = 7 * pen, gap = 5 * pen;
    double walked = 0;  // since a dash began
    std::vector<Pixel> piece{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double length = (path[i + 1] - path[i]).norm();
        for (double done = 0; done < length;) {
            const bool drawing = walked < dash;
            const double step = std::min((drawing ? dash : dash + gap) - walked, length - done);
            done += step;
            walked += step;
            const Pixel here = path[i] + done / length * (path[i + 1] - path[i]);
            if (drawing) piece.push_back(here);
            if (drawing && walked >= dash) on.line(piece, false, width, paint);
            if (walked >= dash + gap - 1e-9) {
                walked = 0;
                piece = {here};
            }
        }
    }
    if (walked < dash) on.line(piece, false, width, paint);
}

}  // namespace grainreel

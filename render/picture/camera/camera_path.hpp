// The camera in the course of a film: it stands, goes round an orbit, or moves from key to key. What it has
// to show comes from framing.hpp.
#pragma once

#include <optional>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A smooth curve through points that never overshoots: between two points it stays between their values. It
// is made of cubic pieces with the slopes of Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: a
// weighted harmonic mean of the secants, and zero at a turning point. It is flat before the first point and
// after the last, and begins and ends with slope zero, so that a camera sets out and arrives gently.
class MonotoneCurve {
  public:
    // times: strictly rising, as many as values, at least one.
    MonotoneCurve(std::vector<double> times, std::vector<double> values);
    double at(double time) const;

  private:
    std::vector<double> times_, values_, slopes_;
};

// Gives an orbit the film's length as its duration, unless the scene gives it a duration of its own.
void settle_orbit(Camera& camera, double film_seconds);

class CameraPath {
  public:
    // A camera that moves keeps one distance, so that the container does not grow and shrink. It is the least
    // distance from which all that is framed is in the port at every moment of the way. An orbit of unknown
    // duration stands still.
    CameraPath(const FilmedScene& scene, const PictureLayout& layout);

    // The view in the lab's frame; for a camera that follows the container, the caller moves it. film_time: s
    // since the first frame.
    View at(double film_time) const;
    bool moves() const { return camera_.moves(); }
    const std::vector<Vec3>& meshes() const { return meshes_; }  // the points of mesh_reach()

  private:
    struct Pose {
        double azimuth, elevation, zoom;  // azimuth and elevation in degrees; zoom is a factor
        Vec3 target;
    };
    using Track = std::optional<MonotoneCurve>;
    template <class Value>
    Track track(double at_first, Value value) const;
    void make_tracks();
    void look_from_position();
    void frame_by_itself(const FilmedScene& scene);
    double frame_part(const FilmedScene& scene, const FramedPart& part);
    FramedPart show_more(const FilmedScene& scene, FramedPart part, double scale);
    void lower(const FilmedScene& scene, const FramedPart& part);
    std::vector<Vec3> points_of(const FilmedScene& scene, const FramedPart& part) const;
    bool leaves_aside(const FilmedScene& scene, const FramedPart& part) const;
    void keep_sides(const FilmedScene& scene, FramedPart part);
    void keep_distance(const FilmedScene& scene, const FramedPart& part);
    double least_depth(const std::vector<Vec3>& points) const;
    std::vector<Pose> samples() const;
    Pose pose(double film_time) const;

    Camera camera_;
    const Rectangle port_;
    const int picture_height_;
    const double margin_;             // pixels, between what is framed and the port's border
    const std::vector<Vec3> meshes_;  // m, outermost points of the meshes
    const Vec3 stroke_;               // m, of the container as it is drawn
    Vec3 target_;
    // The view of a camera that stands still, framed automatically and without a target of its own.
    std::optional<View> still_;
    // m: the distance of the eye from the target, and how far the eye and the point that it looks at are
    // shifted upwards in the picture.
    double distance_ = 0, shift_ = 0;
    double focal_ = 1;                  // pixels, without the zoom
    double radius_ = 0;                 // m: radius about the target of all that is drawn
    Track azimuth_, elevation_, zoom_;  // the zoom's track holds its logarithm
    std::vector<MonotoneCurve> place_;  // x, y, z of the target
};

// The scene's camera as the film begins.
View frame_container(const FilmedScene& scene, const PictureLayout& layout);
// Pixels a metre in the middle of what the scene's camera frames, as the film begins.
double framed_scale(const FilmedScene& scene, const PictureLayout& layout);
// Pixels from the highest to the lowest point that has to be seen by the scene's camera.
double framed_height(const FilmedScene& scene, const PictureLayout& layout);

// Draws the container's motion `factor` times as large as it is, so that it can be seen. Grains keep their
// places relative to the container, so that none is drawn inside a wall. This is right only for a container
// that moves as a whole; the scene's reader refuses all others.
class Exaggeration {
  public:
    explicit Exaggeration(double factor) : factor_(factor) {}

    // The shot as it is drawn. It is valid until the next call, or as long as the shot that was given.
    const Shot& shown(const Shot& frame) {
        if (factor_ == 1) return frame;
        shown_ = frame;
        for (Vec3& position : shown_.position) position += (factor_ - 1) * frame.container().place;
        for (BodyPose& body : shown_.bodies) body.place *= factor_;
        return shown_;
    }
    const Shot& shown(Shot&&) = delete;  // it would not outlive the call

  private:
    const double factor_;
    Shot shown_;
};

}  // namespace grainreel

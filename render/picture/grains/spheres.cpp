// Takes the grains of a frame into view coordinates for the layer of lit spheres, with the glued grains, the
// planes of the cut, the poles that show rotation, and which grains are painted.
#include "render/picture/grains/spheres.hpp"

#include <algorithm>

#include "engine/state/glued_grains.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/grains/shaped_grains.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double kGreyer = 0.55;  // share of the neutral colour in glued grains

}  // namespace

GluedSpheres::GluedSpheres(const FilmedScene& scene) {
    if (!scene.container.wall_grains) return;
    const std::vector<Face> faces = container_faces(scene.container, scene.drive);
    const GluedGrains glued = glue_grains(scene, faces);
    for (std::size_t g = 0; g < glued.size(); ++g) {
        const Face& face = faces[glued.face[g]];
        const Vec3 at = glued.centre(g, faces, {});
        const bool plane = face.kind == Face::Kind::plane;
        const Vec3 inward = plane ? face.normal : Vec3(-Vec3(at.x(), at.y(), 0).normalized());
        glued_.push_back({at, inward, glued.place[g].radius, static_cast<std::size_t>(face.body.number),
                          plane && face.normal.y() != 0});
    }
    const Colour species = scene.film.shows.colour.of_grains()
                               ? neutral_grain
                               : scene.colours[scene.container.wall_grains->species];
    colour_ = to_albedo(mix(species, neutral_grain, kGreyer));
}

std::vector<GluedSpheres::Seen> GluedSpheres::seen(const View& view, const State& frame) const {
    std::vector<Seen> all;
    for (const Glued& one : glued_) {
        const BodyPose pose = frame.body(one.body);
        const Vec3 centre = pose.moved(one.at_rest);
        if (one.at_side || view.faces(centre, pose.rotation * one.inward))
            all.push_back({centre, one.radius});
    }
    return all;
}

Lamp lamp_of(const FilmLook& look, bool colours_are_read) {
    Lamp lamp;
    if (look.style == FilmLook::Style::flat) {  // little shading, and outlines that survive a photocopier
        lamp.key = 0.22f;
        lamp.sky = 0.80f;
        lamp.ground = 0.72f;
        lamp.rim = 0.12f;
        lamp.rim_width = 0.42f;
        lamp.shine = 0;
        lamp.cap = 0.90f;
    } else if (look.style == FilmLook::Style::dark) {  // a harder key, less fill
        lamp.key = 0.90f;
        lamp.sky = 0.50f;
        lamp.ground = 0.20f;
        lamp.rim = 0.85f;
        lamp.shine = 0.20f;
    }
    if (colours_are_read && look.style != FilmLook::Style::flat) {  // light changes colours half as much
        lamp.key = 0.45f;
        lamp.sky = 0.50f;
        lamp.ground = 0.35f;
        lamp.even = 0.32f;
        lamp.shine = 0.05f;
    }
    lamp.occlusion = look.occlusion;
    lamp.shadows = look.shadows;
    return lamp;
}

SpherePainter::SpherePainter(const FilmedScene& scene, int width, int height, Team& team, bool ghosts)
    : grain_colours_(scene),
      glued_(scene),
      team_(team),
      layer_(width, height),
      look_(scene.film.look),
      lamp_(lamp_of(look_, scene.film.shows.colour.of_grains())),
      wall_lamp_(lamp_of(look_, false)),
      up_(scene.film.camera.up) {
    if (!ghosts) return;
    painted_.resize(scene.species.size(), 0);
    for (const std::size_t species : scene.film.shows.ghosts) painted_[species] = 1;
}

void SpherePainter::take(const View& view, const Shot& frame) {
    sight_ = {view.orthographic, static_cast<float>(view.focal), 0.5f * static_cast<float>(view.port.width),
              0.5f * static_cast<float>(view.port.height)};
    lamp_.up[0] = static_cast<float>(view.right.dot(up_));
    lamp_.up[1] = static_cast<float>(view.up.dot(up_));
    lamp_.up[2] = static_cast<float>(view.forward.dot(up_));
    std::copy_n(lamp_.up, 3, wall_lamp_.up);
    spheres_.spheres.resize(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 at = view.to_view(frame.position[i]);
        spheres_.spheres[i] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                               static_cast<float>(at.z()), static_cast<float>(frame.radius[i])};
    }
    spheres_.albedo = grain_colours_.of(frame);
    open_bed(view, frame);
    mark_rotation(view, frame);
    mark_painted(frame);
    add_glued(view, frame);
    give_shapes(view, frame, spheres_);
}

// Grains glued to walls come last, so that all others keep their places.
void SpherePainter::add_glued(const View& view, const State& frame) {
    for (const GluedSpheres::Seen& seen : glued_.seen(view, frame)) {
        const Vec3 at = view.to_view(seen.centre);
        spheres_.spheres.push_back({static_cast<float>(at.x()), static_cast<float>(at.y()),
                                    static_cast<float>(at.z()), static_cast<float>(seen.radius)});
        spheres_.albedo.push_back(glued_.colour());
        if (!spheres_.poles.empty()) spheres_.poles.push_back({});  // one colour all over
        if (!painted_.empty()) spheres_.painted.push_back(0);
    }
}

// Takes the planes of the cut into view coordinates.
void SpherePainter::open_bed(const View& view, const State& frame) {
    cut_.planes = 0;
    for (const HalfSpace& kept : kept_by_cut(look_.cut, frame))
        cut_.plane[cut_.planes++] = {static_cast<float>(kept.normal.dot(view.right)),
                                     static_cast<float>(kept.normal.dot(view.up)),
                                     static_cast<float>(kept.normal.dot(view.forward)),
                                     static_cast<float>(kept.distance - kept.normal.dot(view.eye))};
}

void SpherePainter::mark_rotation(const View& view, const State& frame) {
    spheres_.poles.clear();
    if (!look_.rotation || frame.orientation.size() != frame.size()) return;
    for (const Quaternion& turned : frame.orientation) {
        const Vec3 pole = turned * Vec3::UnitZ();
        spheres_.poles.push_back({static_cast<float>(pole.dot(view.right)),
                                  static_cast<float>(pole.dot(view.up)),
                                  static_cast<float>(pole.dot(view.forward))});
    }
}

void SpherePainter::mark_painted(const State& frame) {
    if (painted_.empty()) return;
    spheres_.painted.clear();
    for (std::size_t i = 0; i < frame.size(); ++i)
        spheres_.painted.push_back(
            not_painted_.empty()
                ? painted_[frame.species[i]]
                : !std::binary_search(not_painted_.begin(), not_painted_.end(), frame.id[i]));
}

void SpherePainter::find_visible(const SolidDepth& solid) {
    layer_.find_visible(sight_, cut_, spheres_, team_, solid);
}

void SpherePainter::find_order(const View& view, const ContainerShapes& walls) {
    faces_.clear();
    for (const WallSide* side : {&walls.behind, &walls.before})
        for (const WallSide::Face& face : side->faces) {
            const Vec3 inward = view.to_view(view.eye + face.inward);
            faces_.push_back(
                {{}, face.alpha, side == &walls.before, inward, face.taken, face.wall, face.container});
            for (const Vec3& corner : face.corners) faces_.back().corners.push_back(view.to_view(corner));
        }
    layer_.find_order(sight_, cut_, spheres_, faces_, team_);
}

void SpherePainter::find_neighbours() {
    layer_.find_neighbours(cut_, lamp_, spheres_, team_);
}

void SpherePainter::light_walls(WallLight& walls, float corner_reach) {
    walls.light_faces(layer_.takers(sight_, cut_, wall_lamp_, spheres_), faces_, corner_reach, team_);
}

void SpherePainter::light_meshes(WallLight& walls, const MeshPixels& meshes) {
    walls.light_meshes(layer_.takers(sight_, cut_, wall_lamp_, spheres_), meshes, team_);
}

const Layer& SpherePainter::light() {
    return layer_.light(sight_, cut_, lamp_, spheres_, team_);
}

}  // namespace grainreel

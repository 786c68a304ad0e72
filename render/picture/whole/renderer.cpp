// The order in which a picture is made: words, walls, ground, spheres, meshes, marks, and then all layers
// together.
#include "render/picture/whole/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "render/picture/base/pdf_page.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/container/ground.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/grains/spheres.hpp"
#include "render/picture/marks/marks.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/whole/draw_stopwatch.hpp"
#include "render/picture/whole/layers.hpp"
#include "render/picture/words/overlay.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

std::uint32_t background(const Colour& colour, bool transparent) {
    const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
    if (transparent) return 0;
    return byte(colour.red) | byte(colour.green) << 8 | byte(colour.blue) << 16 | 0xff000000u;
}

}  // namespace

struct Renderer::Impl {
    Impl(const FilmedScene& s, const PictureLayout& plan, int raster_threads, gl::Provider provider,
         std::shared_ptr<DrawingContext> kept)
        : scene(s),
          palette(palette_of(s.film)),
          layout(plan),
          port(layout.port),
          path(s, layout),
          overlay(scene, palette, layout, path.at(0)),
          drawing(
              current(kept ? std::move(kept) : std::make_shared<DrawingContext>(provider, raster_threads))),
          context(*drawing->context),
          behind(context.gl(), port),
          before(context.gl(), port),
          team(raster_threads),
          shown(s, s.film.shows.hidden),
          solid(s, s.film.shows.ghosts),
          beside_cut(ShownGrains::beside_cut(s)),
          meshes(s),
          marks(scene, palette),
          sphere_painter(s, port.width, port.height, team, false),
          words(s.film.width, s.film.height) {
        if (!s.film.shows.ghosts.empty()) ghost_painter.emplace(s, port.width, port.height, team, true);
        const bool stands = s.container.shape != Container::Shape::none || meshes.any();
        if (s.film.look.ground && !s.film.transparent && stands) ground.emplace(scene, palette, port);
        if (meshes.any()) mesh_painter.emplace(port.width, port.height);
        if (!sphere_painter.takes_light()) return;
        if (s.container.shape != Container::Shape::mesh || !s.walls.empty())
            wall_light.emplace(port.width, port.height);
        if (meshes.any()) mesh_light.emplace(port.width, port.height);
    }

    static std::shared_ptr<DrawingContext> current(std::shared_ptr<DrawingContext> drawing) {
        drawing->context->make_current();
        return drawing;
    }

    // The members that are deleted belong to the context, so the context must be current.
    ~Impl() {
        try {
            context.make_current();
        } catch (const RunError&) {
            // If no context is current, all that the context owns is deleted with the context itself.
        }
    }

    FilmedScene scene;
    Palette palette;
    PictureLayout layout;
    const Rectangle port;
    const CameraPath path;
    Exaggeration exaggeration{scene.film.exaggerate};
    Overlay overlay;
    const std::shared_ptr<DrawingContext> drawing;
    gl::Context& context;
    SideLayer behind, before;
    std::optional<SideLayer> marks_alone;  // used where grains hide parts of the walls in front
    // Pixels of `before` that draw_before() has changed, with the colours that they had.
    std::vector<std::pair<std::uint32_t*, std::uint32_t>> covered;
    std::optional<Ground> ground;
    Team team;
    // The grains that are not hidden, the grains among them that are no ghosts, and the grains that have
    // marks.
    ShownGrains shown, solid, beside_cut;
    SceneMeshes meshes;
    MeshProjection mesh_projection;
    std::optional<MeshPainter> mesh_painter;  // where there are meshes
    Marks marks;
    SpherePainter sphere_painter;
    std::optional<WallLight> wall_light, mesh_light;  // of container and free walls, and of solid meshes
    std::optional<SpherePainter> ghost_painter;
    std::optional<Exposure> exposure;
    bool ground_stands = false;  // whether the ground knows the camera
    bool started = false;        // whether the film has begun, so that start heights are known
    ContainerShapes shapes;
    View eye;
    std::vector<PointForce> point_forces;
    std::vector<char> labelled;  // for each label, whether its grain has been in a frame
    Picture words;               // words beside the port, kept from picture to picture
    Picture picture;             // the picture that draw() returns

    void draw(const Shot& frame, const std::string& playback, double film_time, Picture& into,
              DrawTimes* times, PdfPage* page = nullptr);
    void draw_on_page(PdfPage& page, const Shot& frame, const std::string& playback, const View& view,
                      const Picture& drawn);
    void draw_exposed(const Shot& frame, const View& view, Picture& into, DrawStopwatch& watch);
    void draw_moment(const Shot& frame, const Shot* marked, const View& view, Picture& into,
                     DrawStopwatch& watch);
    const Layer& draw_grains(SpherePainter& painter, DrawStopwatch& watch);
    void draw_solid_meshes(const Shot& frame, DrawStopwatch& watch);
    void draw_other_meshes(DrawStopwatch& watch);
    void light_walls(DrawStopwatch& watch);
    const Layer* draw_before();
    void start_from(const Shot& frame);
    void point_out(PointedOut what);
    // The frame without the grains that the cut takes away, which have no marks. A copy is made only where
    // there are marks.
    const Shot& to_be_marked(const Shot& frame) {
        return has_marks(scene.film.shows) ? beside_cut.of(frame) : frame;
    }
};

void Renderer::Impl::draw(const Shot& frame, const std::string& playback, double film_time, Picture& into,
                          DrawTimes* times, PdfPage* page) {
    context.make_current();
    DrawStopwatch watch(context.gl(), times);
    const View view = path.at(film_time);
    if (!started) start_from(frame);
    if (page)
        overlay.leave_out(words);
    else
        overlay.write(words, frame, playback, view);
    if (ground && (path.moves() || !ground_stands)) ground->stand(view);
    ground_stands = true;
    lay_words({words, overlay, layout, ground ? &*ground : nullptr, path.moves()}, into);
    meshes.colour_by(frame);
    watch.lap(&DrawTimes::overlay);
    if (frame.exposed.empty())
        draw_moment(frame, nullptr, view, into, watch);
    else
        draw_exposed(frame, view, into, watch);
    if (page) return draw_on_page(*page, frame, playback, view, into);
    if (!scene.film.labels.empty())
        draw_grain_labels(scene, exaggeration.shown(frame), eye, layout, palette, into, labelled);
    overlay.lay_over(into);
    watch.lap(&DrawTimes::overlay);
}

void Renderer::Impl::draw_on_page(PdfPage& page, const Shot& frame, const std::string& playback,
                                  const View& view, const Picture& drawn) {
    page.paint(drawn);
    if (!scene.film.labels.empty())
        draw_part(page.on(), port, [&] {
            write_grain_labels(page.on(), scene, exaggeration.shown(frame), eye, layout.type, palette,
                               labelled);
        });
    overlay.draw_on(page.on(), frame, playback, view);
}

void Renderer::Impl::start_from(const Shot& frame) {
    const Shot& start = exaggeration.shown(frame);
    sphere_painter.start_from(start);
    marks.start_from(start);
    if (ghost_painter) ghost_painter->start_from(start);
    started = true;
}

// All grains but those of `what` become ghosts.
void Renderer::Impl::point_out(PointedOut what) {
    point_forces = std::move(what.forces);
    if (what.grains.empty()) return;
    context.make_current();
    if (!ghost_painter) ghost_painter.emplace(scene, port.width, port.height, team, true);
    ghost_painter->paint_all_but(what.grains);
    solid = ShownGrains::only(scene, std::move(what.grains));
}

// Draws all moments while the shutter is open. Each of them gets the marks of the frame itself.
void Renderer::Impl::draw_exposed(const Shot& frame, const View& view, Picture& into, DrawStopwatch& watch) {
    if (!exposure) exposure.emplace(port);
    const Shot marked = to_be_marked(shown.of(exaggeration.shown(frame)));
    for (const ShotPtr& moment : frame.exposed) {
        draw_moment(*moment, &marked, view, into, watch);
        exposure->add(into);
    }
    draw_moment(frame, &marked, view, into, watch);
    exposure->add(into);
    exposure->develop(into);
    watch.lap(&DrawTimes::readback);
}

// marked: the frame whose marks are drawn; null: the frame itself.
void Renderer::Impl::draw_moment(const Shot& true_frame, const Shot* marked, const View& view, Picture& into,
                                 DrawStopwatch& watch) {
    const Shot& frame = exaggeration.shown(true_frame);
    eye = scene.film.camera.follow ? view.moved_by(way_of_container(scene, frame)) : view;
    const Shot& all = shown.of(frame);
    const Shot& opaque = ghost_painter ? solid.of(all) : all;
    const bool bright = sphere_painter.takes_light() && luminance(palette.background) <= 0.18;
    draw_container(scene, {view, eye, path.moves(), scene.film.look.walls.clear, bright}, frame, palette,
                   scene.film.height, shapes);
    watch.lap(&DrawTimes::walls);
    if (ground) ground->update(opaque, eye);
    watch.lap(&DrawTimes::shadow);
    const Layer& walls_behind = behind.draw(drawing->shape_painter, shapes.behind.shapes);
    watch.lap(&DrawTimes::walls);
    sphere_painter.take(eye, opaque);
    watch.lap(&DrawTimes::upload);
    if (mesh_painter) draw_solid_meshes(frame, watch);
    const Layer& grains = draw_grains(sphere_painter, watch);
    light_walls(watch);
    if (mesh_painter) draw_other_meshes(watch);
    if (ghost_painter) ghost_painter->take(eye, all);
    const Layer* ghosts = ghost_painter ? &draw_grains(*ghost_painter, watch) : nullptr;
    const SpherePainter& of_all = ghost_painter ? *ghost_painter : sphere_painter;
    const auto seen = [&](std::size_t i) { return marked ? 1 : of_all.seen_share(beside_cut.place(i)); };
    marks.draw(eye, marked ? *marked : to_be_marked(all), seen, shapes.over);
    draw_point_forces(eye.moved_by(true_frame.container().place - frame.container().place), point_forces,
                      palette, mark_pen(scene.film.height), shapes.over);
    const Layer* marked_alone = draw_before();
    compose({.background = background(palette.background, scene.film.transparent),
             .ground = ground ? &*ground : nullptr,
             .behind = walls_behind,
             .wall_light = wall_light ? &*wall_light : nullptr,
             .meshes_behind = mesh_painter ? &mesh_painter->behind() : nullptr,
             .grains = grains,
             .ghosts = ghosts,
             .meshes_before = mesh_painter ? &mesh_painter->before() : nullptr,
             .before = before.layer(),
             .marks = marked_alone,
             .strengths = exit_fade(scene, eye, port.height, path.meshes())},
            port, into, team);
    for (const auto& [place, pixel] : covered) *place = pixel;
    covered.clear();
    if (scene.film.transparent) divide_by_alpha(into, port);
    watch.lap(&DrawTimes::readback);
}

// Draws the walls in front of the grains, without the parts that grains hide, and the marks over them. Where
// grains hide parts of the walls, the marks are a layer of their own, which is returned.
const Layer* Renderer::Impl::draw_before() {
    const std::vector<WallPixel>& pixels = sphere_painter.wall_pixels();
    const bool bared = std::any_of(pixels.begin(), pixels.end(), [](const auto& p) { return p.bared > 0; });
    if (!bared) shapes.before.shapes.append(shapes.over);
    before.draw(drawing->shape_painter, shapes.before.shapes);
    if (!bared) return nullptr;
    for (const WallPixel& pixel : pixels) {
        std::uint32_t& place = before.layer().row(pixel.y)[pixel.x];
        covered.emplace_back(&place, place);
        place = faded(place, 1 - pixel.bared);
    }
    if (shapes.over.vertices().empty()) return nullptr;
    if (!marks_alone) marks_alone.emplace(context.gl(), port);
    return &marks_alone->draw(drawing->shape_painter, shapes.over);
}

void Renderer::Impl::draw_solid_meshes(const Shot& frame, DrawStopwatch& watch) {
    const MeshPaints paints = mesh_paints(palette, scene.film.camera.up, scene.film.height);
    mesh_projection.take(eye, sphere_painter.sight(), sphere_painter.cut(), meshes.at(frame), paints, team);
    mesh_painter->draw_solid(mesh_projection, sphere_painter.sight(), team);
    watch.lap(&DrawTimes::walls);
}

void Renderer::Impl::draw_other_meshes(DrawStopwatch& watch) {
    mesh_painter->draw_rest(mesh_projection, sphere_painter.sight(), sphere_painter.visibility(),
                            mesh_inks(palette), team);
    watch.lap(&DrawTimes::walls);
}

void Renderer::Impl::light_walls(DrawStopwatch& watch) {
    constexpr double kCornerReach = 0.35;  // of the container's smallest side
    const Container& c = scene.container;
    if (wall_light)
        sphere_painter.light_walls(
            *wall_light, static_cast<float>(kCornerReach * std::min({2 * c.half_width, c.height,
                                                                     is_prism(c) ? c.depth : 1e300})));
    if (mesh_light) {
        sphere_painter.light_meshes(*mesh_light, mesh_painter->pixels(mesh_projection));
        mesh_painter->darken(*mesh_light, team);
    }
    watch.lap(&DrawTimes::shadow);
}

// Draws the grains that the painter has taken.
const Layer& Renderer::Impl::draw_grains(SpherePainter& painter, DrawStopwatch& watch) {
    painter.find_visible(mesh_painter ? mesh_painter->depth() : SolidDepth());
    painter.find_order(eye, shapes);
    watch.lap(&DrawTimes::spheres);
    painter.find_neighbours();
    watch.lap(&DrawTimes::occlusion);
    const Layer& layer = painter.light();
    watch.lap(&DrawTimes::shading);
    return layer;
}

Renderer::Renderer(const FilmedScene& scene, int raster_threads, gl::Provider provider,
                   std::shared_ptr<DrawingContext> kept)
    : Renderer(scene, plan_layout(scene), raster_threads, provider, std::move(kept)) {}
Renderer::Renderer(const FilmedScene& scene, const PictureLayout& layout, int raster_threads,
                   gl::Provider provider, std::shared_ptr<DrawingContext> kept)
    : impl_(std::make_unique<Impl>(scene, layout, raster_threads, provider, std::move(kept))) {}

Renderer::~Renderer() = default;

const Picture& Renderer::draw(const Shot& frame, const std::string& playback, double film_time) {
    draw_into(impl_->picture, frame, playback, film_time);
    return impl_->picture;
}

void Renderer::draw_into(Picture& picture, const Shot& frame, const std::string& playback, double film_time) {
    impl_->draw(frame, playback, film_time, picture, nullptr);
}

void Renderer::draw_page(PdfPage& page, const Shot& frame, const std::string& playback, double film_time) {
    Picture alone;  // not the kept picture, which has words
    impl_->draw(frame, playback, film_time, alone, nullptr, &page);
}

std::string Renderer::last_note() const {
    const GrainColouring& colour = impl_->scene.film.shows.colour;
    const SpherePainter& of_all = impl_->ghost_painter ? *impl_->ghost_painter : impl_->sphere_painter;
    std::string note;
    if (colour.of_grains()) note = clipped_words(colour, of_all.clipped(), "grains");
    if (colour.of_field()) note = clipped_words(colour, impl_->marks.clipped(), "layer");
    const auto add = [&note](const std::string& more) {
        note += (note.empty() || more.empty() ? "" : "; ") + more;
    };
    if (shows_wear(impl_->scene)) add(clipped_words(impl_->scene.film.look.walls, impl_->meshes.clipped()));
    add(missing_labels(impl_->scene, impl_->labelled));
    return note;
}

DrawTimes Renderer::draw_timed(const Shot& frame, const std::string& playback) {
    DrawTimes times;
    impl_->draw(frame, playback, 0, impl_->picture, &times);
    return times;
}

const View& Renderer::view() const {
    return impl_->eye;
}

void Renderer::start_from(const Shot& frame) {
    impl_->start_from(frame);
}

void Renderer::point_out(PointedOut what) {
    impl_->point_out(std::move(what));
}

void Renderer::remember(const Shot& frame) {
    impl_->marks.remember(impl_->to_be_marked(impl_->shown.of(impl_->exaggeration.shown(frame))));
}

std::shared_ptr<DrawingContext> Renderer::context() const {
    return impl_->drawing;
}

std::string Renderer::gl_description() const {
    return impl_->context.description();
}

std::string Renderer::gl_note() const {
    return impl_->context.note();
}

}  // namespace grainreel

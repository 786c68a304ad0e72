#include "render/app/bench_render.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/base/team.hpp"
#include "engine/lab/bench/peers_bed.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/png.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr int kSignalBase = 128;  // 128 + N is the exit status after signal N

Species species(const char* name, double diameter) {
    Species s;
    s.name = name;
    s.diameter = {SizeSpread::Kind::fixed, diameter, diameter, diameter, 0};
    s.density = 2500;
    return s;
}

// A scene whose container is a box as high as the bed.
FilmedScene scene_of(const SettledBed& bed, const BenchRenderRequest& request) {
    FilmedScene scene;
    scene.name = "bench";
    scene.film = request.film;
    scene.species = {species("small", kPeersSmall), species("big", kPeersBig)};
    scene.colours = {{0.337, 0.706, 0.914}, {0.902, 0.624, 0.0}};
    for (const std::int32_t kind : bed.grains.species) ++scene.species[kind].count;
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.5 * bed.side;
    scene.container.depth = bed.side;
    scene.container.height = bed.height;
    scene.container.lid = false;
    scene.drive.present = true;
    scene.drive.frequency = 25;
    scene.drive.amplitude = 1.19e-3;
    return scene;
}

State frame_of(const SettledBed& bed) {
    State frame;
    const Grains& g = bed.grains;
    for (std::size_t i = 0; i < g.size(); ++i) {
        frame.id.push_back(g.id[i]);
        frame.species.push_back(g.species[i]);
        frame.radius.push_back(g.place[i].radius);
        frame.position.push_back(g.place[i].position);
    }
    frame.velocity.assign(g.size(), Vec3(0, 0, 0));
    frame.spin = frame.velocity;
    return frame;
}

// Moves the camera closer until the grains fill the height or the width of their part of the picture, then
// applies the zoom that was asked for.
void fill_picture(FilmedScene& scene, const State& frame) {
    scene.film.words = WordPlace::gutters;  // otherwise a zoom would put the words over the picture
    const double zoom = std::exchange(scene.film.camera.zoom, 1.0);
    const View view = frame_container(scene, plan_layout(scene));
    double widest = 1, highest = 1;  // largest distances from the middle in pixels
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 seen = view.to_view(frame.position[i]);
        const double scale = view.focal / (view.orthographic ? 1 : seen.z());
        widest = std::max(widest, (std::abs(seen.x()) + frame.radius[i]) * scale);
        highest = std::max(highest, (std::abs(seen.y()) + frame.radius[i]) * scale);
    }
    scene.film.camera.zoom =
        zoom * std::min(0.5 * view.port.height / highest, 0.5 * view.port.width / widest);
}

double milliseconds() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

struct DrawStage {
    const char* name;
    double DrawTimes::*time;
};
constexpr std::array<DrawStage, 8> kStages = {{{"upload", &DrawTimes::upload},
                                               {"spheres", &DrawTimes::spheres},
                                               {"shading", &DrawTimes::shading},
                                               {"occlusion", &DrawTimes::occlusion},
                                               {"shadow", &DrawTimes::shadow},
                                               {"walls", &DrawTimes::walls},
                                               {"overlay", &DrawTimes::overlay},
                                               {"readback", &DrawTimes::readback}}};

// The share of the picture that shows grains. It is found by comparing the picture with one without grains.
double coverage(Renderer& renderer, const Shot& frame) {
    const Picture full = renderer.draw(frame, "");
    const Picture& bare = renderer.draw(Shot(), "");
    std::int64_t covered = 0;
    for (std::size_t i = 0; i < full.rgba.size(); i += 4)
        covered += !std::equal(&full.rgba[i], &full.rgba[i] + 3, &bare.rgba[i]);
    return static_cast<double>(covered) / (static_cast<double>(full.width) * full.height);
}

// Medians of the times of the drawing stages. Shadows and occlusion are computed together with a grain's
// light, so their cost is the difference from a picture without them.
class DrawnStages {
  public:
    DrawnStages(const FilmedScene& scene, int threads) {
        FilmedScene less = scene;
        add(less, threads);
        less.film.look.shadows = false;
        add(less, threads);
        less.film.look.occlusion = false;
        add(less, threads);
    }
    Renderer& full() { return *renderers_.front().renderer; }

    void measure(const Shot& frame) {
        for (Variant& variant : renderers_) {
            const DrawTimes times = variant.renderer->draw_timed(frame, "");
            for (std::size_t s = 0; s < kStages.size(); ++s)
                variant.times[s].push_back(times.*kStages[s].time);
        }
    }
    DrawTimes medians() const {
        const DrawTimes all = of(0), unshadowed = of(1), plain = of(2);
        const auto light = [](const DrawTimes& t) { return t.occlusion + t.shading; };
        DrawTimes times = all;
        times.shading = light(plain);
        times.occlusion = std::max(0.0, light(unshadowed) - light(plain));
        times.shadow += std::max(0.0, light(all) - light(unshadowed));
        return times;
    }

  private:
    struct Variant {
        std::unique_ptr<Renderer> renderer;
        std::array<std::vector<double>, kStages.size()> times;
    };
    void add(const FilmedScene& scene, int threads) {
        renderers_.push_back({std::make_unique<Renderer>(scene, threads), {}});
    }
    DrawTimes of(std::size_t variant) const {
        DrawTimes times;
        for (std::size_t s = 0; s < kStages.size(); ++s)
            times.*kStages[s].time = median(renderers_[variant].times[s]);
        return times;
    }

    std::vector<Variant> renderers_;
};

double encode_time(const Picture& picture, const Film& film, int threads) {
    const ScratchFolder folder("bench");
    constexpr int kFrames = 30;
    const double begin = milliseconds();
    {
        EncoderSettings settings;
        settings.path = folder.path() / "film.mp4";
        settings.width = film.width;
        settings.height = film.height;
        settings.quality = film.quality;
        settings.preset = film.preset;
        settings.threads = threads;
        Encoder encoder(settings);
        for (int i = 0; i < kFrames; ++i) encoder.add(picture);
        encoder.finish();
    }
    const double taken = milliseconds() - begin;
    return taken / kFrames;
}

// Writes the picture, and the two files from which another renderer can draw the same picture: the spheres in
// view coordinates (x right, y up, z away from the eye) and the camera.
void keep(const std::filesystem::path& folder, const Picture& picture, const State& frame, const View& view) {
    std::filesystem::create_directories(folder);
    write_png(folder / "picture.png", picture, {});
    std::string table = "x,y,z,radius,species\n";
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 seen = view.to_view(frame.position[i]);
        table += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{}\n", seen.x(), seen.y(), seen.z(),
                             frame.radius[i], frame.species[i]);
    }
    replace_file(folder / "grains.csv", table);
    const Lamp lamp;
    const nlohmann::ordered_json camera = {
        {"orthographic", view.orthographic},
        {"focal", view.focal},
        {"centre", {view.port.x + 0.5 * view.port.width, view.port.y + 0.5 * view.port.height}},
        {"width", picture.width},
        {"height", picture.height},
        {"to_key", lamp.to_key}};
    replace_file(folder / "camera.json", camera.dump(2) + "\n");
}

}  // namespace

int bench_render(const BenchRenderRequest& request, Reporter& reporter) {
    const int threads = request.threads > 0 ? request.threads : usable_processors();
    const ShareWatcher watcher(reporter, Progress::Stage::timing);
    const SettledBed bed =
        settled_bed(request.grains, threads, [&](double done) { return watcher("settling", 0.5 * done); });
    if (bed.grains.size() == 0) {
        reporter.info("stopped; nothing was measured to its end");
        return kSignalBase + stop_signal();
    }
    FilmedScene scene = scene_of(bed, request);
    const Shot frame = frame_of(bed);
    fill_picture(scene, frame);
    DrawnStages stages(scene, threads);
    Renderer& renderer = stages.full();
    const double covered = coverage(renderer, frame);
    std::vector<double> totals;
    for (int r = 0; r < request.repeats; ++r) {
        if (!watcher("drawing", 0.5 + 0.5 * r / request.repeats)) break;
        const double begin = milliseconds();
        renderer.draw(frame, "");
        totals.push_back(milliseconds() - begin);
        stages.measure(frame);
    }
    reporter.clear();
    if (totals.empty()) return kSignalBase + stop_signal();
    const Picture& picture = renderer.draw(frame, "");
    if (request.out) keep(*request.out, picture, frame, renderer.view());
    using Json = nlohmann::ordered_json;
    Json ms = {{"total", median(totals)}};
    const DrawTimes medians = stages.medians();
    for (const DrawStage& stage : kStages) ms[stage.name] = medians.*stage.time;
    ms["encode"] = encode_time(picture, scene.film, threads);
    const Json all = {{"grains", bed.grains.size()},
                      {"width", scene.film.width},
                      {"height", scene.film.height},
                      {"style", request.style},
                      {"gl", renderer.gl_description()},
                      {"threads", threads},
                      {"coverage", covered},
                      {"ms_per_frame", ms}};
    if (request.json) {
        print_result(all.dump(2) + "\n");
        return 0;
    }
    print_result(fmt::format("{}, {}x{}, {}, {}, coverage {:.2f}; ms a frame (median of {}):\n",
                             counted(bed.grains.size(), "grain"), scene.film.width, scene.film.height,
                             renderer.gl_description(), counted(threads, "thread"), covered, totals.size()));
    for (const auto& [name, value] : ms.items())
        print_result(fmt::format("{:>12}{:>9.2f}\n", name, value.get<double>()));
    return 0;
}

}  // namespace grainreel

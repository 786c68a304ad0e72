#include "render/app/estimate/film_probe.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/scene/bed.hpp"
#include "render/app/messages/stop_signal.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr int most_drawn = 48, least_drawn = 4;
constexpr double patience = 1.5;  // s, after which no further frame is begun
constexpr std::int64_t most_grains = 200'000;
constexpr double solid_fraction = 0.5;  // of a bed that is shaken
// A frame of the shipped scenes' runs takes 0.7 to 0.9 of one of the stack, in which more grains are seen.
constexpr double run_over_stack = 0.8;

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class ProbeFolder {
  public:
    ProbeFolder() {
        std::string name = (fs::temp_directory_path() / "grainreel-check-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw RunError(name + ": cannot be made");
        path_ = name;
    }
    ~ProbeFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ProbeFolder(const ProbeFolder&) = delete;
    ProbeFolder& operator=(const ProbeFolder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

void add_grain(Frame& frame, std::size_t species, double radius, const Vec3& position) {
    frame.id.push_back(static_cast<std::int32_t>(frame.size()));
    frame.species.push_back(static_cast<std::int32_t>(species));
    frame.radius.push_back(radius);
    frame.position.push_back(position);
    frame.velocity.push_back(Vec3::Zero());
    frame.spin.push_back(Vec3::Zero());
}

// Which species come one after another, so that all are spread over the bed.
std::vector<std::size_t> spread_species(const FilmedScene& scene) {
    std::vector<std::size_t> all;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        all.insert(all.end(), static_cast<std::size_t>(scene.species[s].all()), s);
    Random random(1, Stream::centres);
    for (std::size_t i = all.size(); i > 1; --i)
        std::swap(
            all[i - 1],
            all[std::min(i - 1, static_cast<std::size_t>(random.between(0, 1) * static_cast<double>(i)))]);
    return all;
}

// As between two frames in slow motion: the bed moves as a whole, and every grain a little off its place.
FramePtr shaken(const Frame& bed, int k, Random& random) {
    Frame frame = bed;
    frame.step = k;
    frame.time = 0.01 * k;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const double reach = 0.01 * frame.radius[i];
        const auto off = [&] { return random.between(-reach, reach); };
        frame.velocity[i] = 10 * Vec3(off(), off(), off());
        frame.position[i] += Vec3(off(), off(), off() + 0.3 * frame.radius[0] * (k % 4));
    }
    return std::make_shared<const Frame>(std::move(frame));
}

struct FilmUse {
    int frames = 0;
    double seconds = 0;  // of processor time
    double drawing = 0;  // share of that
};

// Time and bytes of a film of so many frames, or of fewer where they take long.
FilmUse use_of_film(const FilmedScene& scene, const ThreadPlan& threads, const Frame& bed, int most,
                    const HeldSignals& signals) {
    const ProbeFolder folder;
    FilmOptions options;
    options.folder = folder.path();
    options.raster_threads = threads.raster;
    options.encoder_threads = threads.encoder;
    options.pictures = most;
    Random random(2, Stream::centres);
    const Stopwatch watch;
    const double before = processor_seconds();
    FilmMaker film(scene, options);
    FilmUse use;
    const auto goes_on = [&] {
        if (signals.waiting()) return false;
        return use.frames < most && (use.frames < least_drawn || watch.seconds() < patience);
    };
    for (; goes_on(); ++use.frames) film.take(shaken(bed, use.frames, random), "");
    const FilmReport report = film.finish();
    const double busy = report.draw_seconds + report.encode_seconds;
    use.seconds = processor_seconds() - before;
    use.drawing = busy > 0 ? report.draw_seconds / busy : 0.5;
    return use;
}

}  // namespace

namespace {

// From the bottom of a box upwards, as far as they go.
Frame stacked_in(const FilmedScene& scene, const std::vector<std::size_t>& species, double pitch,
                 const Region& box) {
    Frame frame;
    for (double z = box.low.z() + pitch / 2; z < box.high.z(); z += pitch)
        for (double x = box.low.x() + pitch / 2; x < box.high.x(); x += pitch)
            for (double y = box.low.y() + pitch / 2; y < box.high.y(); y += pitch) {
                if (frame.size() == species.size()) return frame;
                const std::size_t of = species[frame.size()];
                add_grain(frame, of, scene.species[of].diameter.mean / 2, Vec3(x, y, z));
            }
    return frame;
}

}  // namespace

Frame stacked_bed(const FilmedScene& scene) {
    Frame frame;
    if (scene.start.method == Start::Method::grains) {
        for (const ListedGrain& grain : scene.start.grains)
            add_grain(frame, grain.species, grain.diameter / 2, grain.position);
        return frame;
    }
    if (scene.grains() == 0) return frame;
    const Container& c = scene.container;
    const std::vector<std::size_t> species = spread_species(scene);
    const double pitch =
        std::cbrt(solid_volume(scene) / static_cast<double>(species.size()) / solid_fraction);
    const double most = pitch * static_cast<double>(species.size());  // m, of a row of all grains
    if (const auto& region = scene.start.region) return stacked_in(scene, species, pitch, *region);
    const bool vessel = c.shape == Container::Shape::mesh;
    const double widest = std::min(most, c.shape == Container::Shape::cylinder ? c.half_width : c.depth / 2);
    const double high = std::min(most, c.height - c.base()) + c.base();
    for (double z = c.base() + pitch / 2; z < high && frame.size() < species.size(); z += pitch) {
        const double wide = std::min(most, c.half_width_at(z));
        const double deep = vessel ? std::min(most, c.room->half_depth_at(z)) : widest;
        for (double x = -deep + pitch / 2; x < deep && frame.size() < species.size(); x += pitch)
            for (double y = -wide + pitch / 2; y < wide && frame.size() < species.size(); y += pitch) {
                if (c.shape == Container::Shape::cylinder && x * x + y * y > wide * wide) continue;
                const std::size_t of = species[frame.size()];
                add_grain(frame, of, scene.species[of].diameter.mean / 2, Vec3(x, y, z));
            }
    }
    return frame;
}

std::optional<FilmSpeed> probe_film(const FilmedScene& scene, const ThreadPlan& threads) {
    if (scene.grains() > most_grains) return std::nullopt;
    const HeldSignals signals;  // the folder of the film is to go first
    try {
        const Frame bed = stacked_bed(scene);
        // The program's first film loads libraries and fonts. It is not counted: a small picture takes less.
        use_of_film(scene, threads, bed, 1, signals);
        // What a film takes before its frames is in both, and so in neither's difference.
        const FilmUse setup = use_of_film(scene, threads, bed, 1, signals);
        const FilmUse film = use_of_film(scene, threads, bed, most_drawn, signals);
        if (film.frames < least_drawn) return std::nullopt;
        const double frames = std::max(0.2 * film.seconds, film.seconds - setup.seconds);
        return FilmSpeed{run_over_stack * frames / (film.frames - 1), film.drawing};
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace grainreel

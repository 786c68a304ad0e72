#include "render/cli/check.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/team.hpp"
#include "engine/chart/promised_error.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/data_size.hpp"
#include "render/cli/thread_plan.hpp"
#include "render/film/codec.hpp"
#include "render/film/film_limits.hpp"
#include "render/film/sampler.hpp"

namespace grainreel {
namespace {

// What the estimates assume; measured on one 2-core x86-64 machine, good to a factor of two.
constexpr double steps_a_second = 8e6;    // grains x steps, a thread
constexpr double seconds_a_frame = 0.15;  // drawing and encoding at 1920x1080
constexpr double engine_bytes_a_grain = 600;
constexpr double bytes_a_pixel = 122;  // from the renderer to the encoder, and what those keep themselves
constexpr double bytes_of_program = 138e6;  // with its libraries, the software rasteriser above all
constexpr double trajectory_bytes = 64;     // a grain and frame: id, type, radius, x in double, v, spin
constexpr double orientation_bytes = 16;
constexpr double measures_bytes = 400;  // a row
constexpr double full_hd = 1920.0 * 1080;
constexpr double assumed_settling = 1.2;  // s, simulated

std::string length(double metres) {
    const double size = std::abs(metres);
    if (size >= 1) return fmt::format("{:.4g} m", metres);
    if (size >= 1e-3 || size == 0) return fmt::format("{:.4g} mm", metres * 1e3);
    return fmt::format("{:.3g} um", metres * 1e6);
}

std::string span(double seconds) {
    if (seconds >= 5400) return fmt::format("{:.1f} h", seconds / 3600);
    if (seconds >= 90) return fmt::format("{:.1f} min", seconds / 60);
    if (seconds >= 0.1) return fmt::format("{:.3g} s", seconds);
    return seconds >= 1e-3 ? fmt::format("{:.3g} ms", seconds * 1e3)
                           : fmt::format("{:.3g} us", seconds * 1e6);
}

// 1234567 as "1,234,567".
std::string grouped(std::int64_t count) {
    std::string digits = fmt::format("{}", count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

// Lines of a name and a text, the texts below each other.
class Listing {
  public:
    explicit Listing(std::ostream& out) : out_(out) {}
    void line(std::string_view name, const std::string& text) { fmt::print(out_, "{:<13}{}\n", name, text); }
    void gap() { out_ << '\n'; }

  private:
    std::ostream& out_;
};

std::string diameter_text(const SizeSpread& d) {
    switch (d.kind) {
        case SizeSpread::Kind::fixed:
            return length(d.mean);
        case SizeSpread::Kind::uniform:
            return fmt::format("{} to {}", length(d.smallest), length(d.largest));
        case SizeSpread::Kind::normal:
            break;
    }
    return fmt::format("{} +- {}", length(d.mean), length(d.deviation));
}

std::string container_text(const Container& c) {
    const std::string top = c.lid ? "closed by a lid" : "open above";
    switch (c.shape) {
        case Container::Shape::wedge:
            return fmt::format(
                "wedge, {:.4g} deg from the vertical up to {}, width {} at the floor and {} above, depth "
                "{}{}, "
                "height {}, {}",
                c.half_angle * 180 / std::numbers::pi, length(c.slant_height),
                length(2 * c.floor_half_width()), length(2 * c.half_width), length(c.depth),
                c.periodic_depth ? " (periodic)" : "", length(c.height), top);
        case Container::Shape::box:
            return fmt::format("box, width {}, depth {}{}, height {}, {}", length(2 * c.half_width),
                               length(c.depth), c.periodic_depth ? " (periodic)" : "", length(c.height), top);
        case Container::Shape::none:
            return "none";
        case Container::Shape::cylinder:
            break;
    }
    return fmt::format("cylinder, diameter {}, height {}, {}", length(2 * c.half_width), length(c.height),
                       top);
}

std::string wall_text(const FreeWall& wall) {
    std::string text = fmt::format("{}: plane towards ({:.3g}, {:.3g}, {:.3g})", wall.name, wall.normal.x(),
                                   wall.normal.y(), wall.normal.z());
    if (wall.velocity.norm() > 0) text += fmt::format(", moving at {:.3g} m/s", wall.velocity.norm());
    return wall.moves ? text + ", follows the drive" : text;
}

std::string drive_text(const Scene& scene) {
    const Drive& d = scene.drive;
    if (!d.present) return "none";
    const double g = scene.gravity.norm();
    const std::string level = g > 0 ? fmt::format(", gamma {:.4g}", d.g_level(g)) : "";
    const std::string along = d.direction == Vec3(0, 0, 1)
                                  ? "up and down"
                                  : fmt::format("along ({:.3g}, {:.3g}, {:.3g})", d.direction.x(),
                                                d.direction.y(), d.direction.z());
    const std::string ramp = d.ramp > 0 ? fmt::format("grows over {:.3g} periods", d.ramp) : "starts at once";
    const std::string phase = d.phase != 0 ? fmt::format(", phase {:.4g} deg", d.phase * 360) : "";
    return fmt::format("{} {}, {:.4g} Hz, amplitude {}{}, top speed {:.3g} m/s{}, {}",
                       d.moves == Drive::Moves::container ? "container" : "floor", along, d.frequency,
                       length(d.amplitude), level, d.speed(), phase, ramp);
}

void print_setup(const Scene& scene, const Plan& plan, Listing& list) {
    list.line("scene", fmt::format("{} ({})", scene.title, scene.file));
    list.line("grains", fmt::format("{}, {:.3g} kg", grouped(scene.grains()), total_mass(scene)));
    for (const Species& s : scene.species)
        list.line("", fmt::format("{} {} of {}, {:.4g} kg/m3", grouped(s.count), s.name,
                                  diameter_text(s.diameter), s.density));
    list.line("container", container_text(scene.container));
    for (const FreeWall& wall : scene.walls) list.line("", wall_text(wall));
    if (scene.start.method != Start::Method::grains)
        list.line("bed",
                  fmt::format("about {} high at rest, {:.0f} % of the container's height",
                              length(plan.bed_height), 100 * plan.bed_height / scene.container.height));
    list.line("gravity", fmt::format("{:.4g} m/s2", scene.gravity.norm()));
    list.line("drive", drive_text(scene));
}

void print_model(const Scene& scene, const Plan& plan, Listing& list) {
    std::vector<std::string> in, out;
    const auto any = [&](auto&& is) {
        const auto of = [&](const PairPlan& pair) { return is(pair.model); };
        return std::any_of(plan.grain.begin(), plan.grain.end(), of) ||
               std::any_of(plan.wall.begin(), plan.wall.end(), of);
    };
    const auto note = [&](bool used, const char* what) {
        if (used) in.push_back(what);
    };
    const auto normal = [&](NormalForce law) {
        return any([&](const ContactModel& m) { return m.normal == law; });
    };
    const auto tangential = [&](TangentialLaw law) {
        return any([&](const ContactModel& m) { return m.tangential == law; });
    };
    const bool by_speed = normal(NormalForce::walton_braun_speed) || normal(NormalForce::walton_braun_table);
    const bool corrected = normal(NormalForce::walton_braun_corrected);
    note(normal(NormalForce::walton_braun) || corrected || by_speed,
         "normal force: Walton-Braun latching spring");
    note(corrected, "corrections of onset, peak and exit");
    note(by_speed, "restitution that depends on speed");
    note(normal(NormalForce::spring_dashpot), "normal force: linear spring and dashpot");
    note(normal(NormalForce::hertz), "normal force: Hertz with dashpot");
    note(tangential(TangentialLaw::incremental_slip), "friction: Walton's incremental slip");
    note(tangential(TangentialLaw::linear_spring), "friction: linear spring with Coulomb's cap");
    note(tangential(TangentialLaw::mindlin), "friction: Mindlin's spring with Coulomb's cap");
    const bool rubs = plan.rubs();
    (plan.rolls() ? in : out).push_back("rolling resistance");
    note(scene.run.precision == Precision::mixed, "contact laws in single precision");
    (rubs ? in : out).push_back("spin and torque");
    if (!rubs) out.push_back("friction");
    (scene.gravity.norm() > 0 ? in : out).push_back("gravity");
    (plan.moving_walls ? in : out).push_back("moving walls");
    for (const char* absent : {"air", "cohesion", "wear and breakage"}) out.push_back(absent);
    if (normal(NormalForce::walton_braun) || corrected) out.push_back("restitution that depends on speed");
    list.line("modelled", fmt::format("{}", fmt::join(in, ", ")));
    list.line("left out", fmt::format("{}", fmt::join(out, ", ")));
}

std::string stiffness_text(const PairPlan& pair) {
    return pair.modulus > 0 ? fmt::format("{:.3g} Pa", pair.modulus)
                            : fmt::format("{:.3g} N/m", pair.loading_stiffness);
}

void print_contacts(const Scene& scene, const Plan& plan, std::ostream& out) {
    std::size_t widest = 8;
    for (const Species& s : scene.species) widest = std::max(widest, 2 * s.name.size() + 3);
    fmt::print(out, "{:<13}{:<{}}{:>14}  {:<13}{:>6}{:>8}{:>10}{:>12}{:>9}\n", "contacts", "", widest,
               "stiffness", "chosen for", "e", "error", "friction", "duration", "steps");
    const auto row = [&](const std::string& name, const PairPlan& pair, const Species& a, const Species* b) {
        fmt::print(out, "{:<13}{:<{}}{:>14}  {:<13}{:>6.3g}{:>8}{:>10.3g}{:>12}{:>9.1f}\n", "", name, widest,
                   stiffness_text(pair), pair.stiffness_reason, pair.restitution,
                   promised_error_text(promised_restitution_error(plan, pair, a, b)), pair.friction,
                   span(pair.contact_time), pair.contact_time / plan.clock.step);
    };
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        for (std::size_t b = a; b < scene.species.size(); ++b)
            if (a != b || scene.species[a].count > 1)  // a single grain never meets its like
                row(scene.species[a].name + " - " + scene.species[b].name, plan.between(a, b),
                    scene.species[a], &scene.species[b]);
        row(scene.species[a].name + " - wall", plan.wall[a], scene.species[a], nullptr);
    }
}

void print_time(const Scene& scene, const Plan& plan, Listing& list) {
    const std::int64_t period = plan.clock.steps_per_period;
    list.line("step",
              fmt::format("{}{}, chosen for: {}", span(plan.clock.step),
                          period > 0 ? fmt::format(", {} a period", grouped(period)) : "", plan.step_reason));
    list.line("steps", fmt::format("{} for {}", grouped(plan.steps), span(plan.clock.time(plan.steps))));
    list.line("start",
              scene.start.method == Start::Method::file ? "from " + scene.start.file
              : scene.start.method == Start::Method::grains
                  ? "the grains as listed"
                  : fmt::format("layers, then settling for {} at most", span(scene.start.settle_limit)));
    list.line("overlap",
              fmt::format("up to {:.2g} % of the smaller diameter expected, with impacts at {:.3g} m/s; most "
                          "contacts stay below {:.2g} %",
                          100 * plan.expected_overlap, plan.impact_speed, 100 * scene.run.overlap));
}

struct FilmCost {
    std::size_t frames = 0;
    double seconds = 0;  // to draw and encode
    double playing = 0;  // s
    double pixels = 0;   // over those of 1920x1080
};

FilmCost film_cost(const Scene& scene, const Plan& plan) {
    FilmCost cost;
    const Film& film = scene.film;
    cost.frames = film_schedule(scene, plan.clock, plan.steps).size();
    cost.playing = static_cast<double>(cost.frames) / film.rate;
    cost.pixels = static_cast<double>(film.width) * film.height / full_hd;
    cost.seconds = static_cast<double>(cost.frames) * seconds_a_frame * cost.pixels;
    return cost;
}

std::string film_format_text(const Film& film) {
    return film.format == FilmFormat::png ? std::string("PNG pictures") : codec_of(film.format).words;
}

void print_files(const Scene& scene, const Plan& plan, const FilmCost& film, Listing& list) {
    list.line("film", fmt::format("{}x{}, {:.4g} frames/s, {} frames, plays for {}", scene.film.width,
                                  scene.film.height, scene.film.rate, film.frames, span(film.playing)));
    for (const FilmSegment& segment : scene.film.segments)
        list.line("", fmt::format("{}: {}", segment.duration ? span(*segment.duration) : "the rest",
                                  playback_caption(segment, scene.drive, scene.film.rate)));
    list.line("files",
              fmt::format(
                  "film ({}) about {}{}", film_format_text(scene.film),
                  data_size_text(estimated_film_size(scene.film, static_cast<std::int64_t>(film.frames))),
                  scene.film.max_size
                      ? fmt::format(", {} at most", data_size_text(static_cast<double>(*scene.film.max_size)))
                      : ""));
    const auto grains = static_cast<double>(scene.grains());
    if (plan.trajectory_every > 0) {
        const auto frames =
            static_cast<std::int64_t>(static_cast<double>(plan.steps) / plan.trajectory_every) + 1;
        const double size = trajectory_bytes + (scene.keeps_orientations() ? orientation_bytes : 0);
        list.line("", fmt::format("trajectory {}, {} frames, one every {}",
                                  data_size_text(static_cast<double>(frames) * grains * size),
                                  grouped(frames), span(plan.trajectory_every * plan.clock.step)));
    }
    const auto rows = static_cast<std::int64_t>(static_cast<double>(plan.steps) / plan.measures_every) + 1;
    list.line("", fmt::format("measures {}, {} rows, one every {}",
                              data_size_text(static_cast<double>(rows) * measures_bytes), grouped(rows),
                              span(plan.measures_every * plan.clock.step)));
}

void print_cost(const Scene& scene, const Plan& plan, const FilmCost& film, Listing& list) {
    const auto grains = static_cast<double>(scene.grains());
    const double pixels = static_cast<double>(scene.film.width) * scene.film.height;
    list.line("memory",
              fmt::format("about {}", data_size_text(bytes_of_program + grains * engine_bytes_a_grain +
                                                     pixels * bytes_a_pixel)));
    const double settling =
        std::min(static_cast<double>(plan.settle_steps_limit), assumed_settling / plan.clock.step);
    const double work = grains * (static_cast<double>(plan.steps) + settling);
    const int threads = scene.run.threads > 0 ? scene.run.threads : usable_processors();
    const double engine = work / steps_a_second;
    list.line("cost",
              fmt::format("{:.2g} grain-steps, {:.0f} % of them for packing: {} of one thread at {:.2g} a "
                          "second",
                          work, 100 * grains * settling / work, span(engine), steps_a_second));
    list.line("", fmt::format("{} of one thread for the film, at {} a frame", span(film.seconds),
                              span(seconds_a_frame * film.pixels)));
    list.line("", fmt::format("together about {} on {} thread{}", span((engine + film.seconds) / threads),
                              threads, threads == 1 ? "" : "s"));
}

}  // namespace

void print_plan(const Scene& scene, const Plan& plan, std::ostream& out) {
    Listing list(out);
    print_setup(scene, plan, list);
    list.gap();
    print_model(scene, plan, list);
    list.gap();
    print_contacts(scene, plan, out);
    print_time(scene, plan, list);
    list.gap();
    const FilmCost film = film_cost(scene, plan);
    print_files(scene, plan, film, list);
    print_cost(scene, plan, film, list);
    std::vector<std::string> warnings = plan.warnings;
    for (std::string& line : strobe_warnings(scene.film, scene.drive)) warnings.push_back(std::move(line));
    for (std::string& line : film_warnings(scene, static_cast<std::int64_t>(film.frames)))
        warnings.push_back(std::move(line));
    if (!warnings.empty()) list.gap();
    for (const std::string& line : warnings) list.line("warning", line);
}

}  // namespace grainreel

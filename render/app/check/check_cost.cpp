// Writes what `check` says about the results of a run and their cost, and estimates the cost of a study.
#include "render/app/check/check_cost.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "engine/base/counted.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/team.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/app/estimate/cost_estimate.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// The interval between two records in words: "period", "2 periods", "5 ms".
std::string interval_text(double periods, double steps, const Plan& plan) {
    if (periods > 0) return periods == 1 ? "period" : fmt::format("{:.3g} periods", periods);
    return span_text(steps * plan.clock.step);
}

constexpr double engine_bytes_a_grain = 600;
constexpr double bytes_a_pixel = 122;  // for pictures in the renderer, in the encoder and between them
constexpr double bytes_of_program =
    138e6;  // with its libraries, of which the software rasteriser is the largest

std::string film_format_text(const Film& film) {
    return film.format == FilmFormat::png ? std::string("PNG pictures") : codec_of(film.format).words;
}

constexpr std::int64_t fewest_to_hand_over = 20000;  // grains; enough for four ranks (processes of MPI)
constexpr double long_run = 24 * 3600;               // s
constexpr double much_faster = 3;

// Says how long the run would take in other engines, on as many ranks as its grains can use, and whether it
// should be handed over to one. Only for beds that are large enough for that.
void print_elsewhere(const Scene& scene, const Plan& plan, const CostEstimate& here, Listing& list) {
    const std::int64_t grains = scene.grains(), ranks = useful_ranks(grains);
    if (grains < fewest_to_hand_over) return;
    const ReferenceFrame frame =
        scene.drive.moves == Drive::Moves::floor ? ReferenceFrame::lab : ReferenceFrame::container;
    const int count = static_cast<int>(std::min<std::int64_t>(ranks, 1'000'000));
    double fastest = INFINITY;
    std::string name = "elsewhere";
    for (const PeerEngine engine : {PeerEngine::lammps, PeerEngine::liggghts}) {
        const double seconds = peer_seconds(engine, frame, grains, plan.steps, count);
        fastest = std::min(fastest, seconds);
        list.line(name,
                  fmt::format("{}: about {} on {} ranks, with {} in all", name_of(engine), span_text(seconds),
                              grouped(count), data_size_text(peer_bytes(engine, grains))));
        name.clear();
    }
    const double mine = here.packing_seconds + here.engine_seconds;
    list.line(
        "", mine > long_run && mine > much_faster * fastest
                ? fmt::format(
                      "hand it over where you have as many processors: {} handover (docs/guide/clusters.md)",
                      program_call())
                : fmt::format("stay here: one of our threads does the work of {:.0f} ranks", kRanksAThread));
}

std::string threads_text(int threads) {
    return counted(threads, "thread");
}

}  // namespace

std::int64_t frames_of(const std::vector<SegmentCount>& film) {
    std::int64_t frames = 0;
    for (const SegmentCount& segment : film) frames += segment.shots;
    return frames;
}

void print_files(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                 Listing& list) {
    const std::int64_t pictures = frames_of(film), held = held_frames(scene.film);
    const DiskEstimate disk = estimate_disk(scene, plan, pictures + held);
    list.line("film", fmt::format("{}x{}, {:.4g} frames/s, {}, plays for {}", scene.film.width,
                                  scene.film.height, scene.film.rate, counted(pictures + held, "frame"),
                                  span_text(static_cast<double>(pictures + held) / scene.film.rate)));
    if (held > 0)
        list.line("", fmt::format("{} of that it stands still for captions",
                                  span_text(static_cast<double>(held) / scene.film.rate)));
    for (const FilmSegment& segment : scene.film.segments)
        list.line("", fmt::format("{}: {}", segment.duration ? span_text(*segment.duration) : "the rest",
                                  playback_caption(played(segment, scene.film.rate, plan.clock), scene.drive,
                                                   scene.film.rate)));
    list.line("files",
              fmt::format(
                  "film ({}) about {}{}", film_format_text(scene.film), data_size_text(disk.film),
                  scene.film.max_size
                      ? fmt::format(", {} at most", data_size_text(static_cast<double>(*scene.film.max_size)))
                      : ""));
    if (disk.trajectory_frames > 0)
        list.line("", fmt::format("trajectory {}, {} frame{}, one every {}", data_size_text(disk.trajectory),
                                  grouped(disk.trajectory_frames), disk.trajectory_frames == 1 ? "" : "s",
                                  interval_text(plan.trajectory_periods, plan.trajectory_every, plan)));
    list.line("", fmt::format("measures {}, {} row{}, one every {}", data_size_text(disk.measures),
                              grouped(disk.measures_rows), disk.measures_rows == 1 ? "" : "s",
                              interval_text(plan.measures_periods, plan.measures_every, plan)));
    if (disk.checkpoints + disk.film_moments > 0)
        list.line("", fmt::format("so that any moment comes back: {}{}{}",
                                  disk.checkpoints > 0
                                      ? fmt::format("checkpoints up to {}", data_size_text(disk.checkpoints))
                                      : "",
                                  disk.checkpoints > 0 && disk.film_moments > 0 ? ", " : "",
                                  disk.film_moments > 0 ? fmt::format("moments of the film {}",
                                                                      data_size_text(disk.film_moments))
                                                        : ""));
}

void print_cost(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                Listing& list) {
    const auto grains = static_cast<double>(scene.grains());
    const double pixels = static_cast<double>(scene.film.width) * scene.film.height;
    list.line("memory",
              fmt::format("about {}", data_size_text(bytes_of_program + grains * engine_bytes_a_grain +
                                                     pixels * bytes_a_pixel)));
    const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
    const ThreadPlan threads = plan_threads(processors, true, scene.grains());
    const MachineFigures machine = machine_figures(scene, plan, threads);
    const CostEstimate cost = estimate_cost(scene, plan, film, threads, machine);
    list.line("cost",
              fmt::format("{:.2g} grain-steps, {:.0f} % of them for packing: {} on {}, at {:.2g} a second "
                          "and thread",
                          cost.grain_steps, 100 * cost.packing_share,
                          span_text(cost.packing_seconds + cost.engine_seconds), threads_text(threads.engine),
                          cost.engine_one));
    list.line("", fmt::format("{} for the film, with {} of one processor's time a frame",
                              span_text(cost.film_seconds), span_text(cost.frame_seconds)));
    list.line("", fmt::format(
                      "together about {} on {}, {}", span_text(cost.total_seconds), threads_text(processors),
                      threads.take_turns ? "engine and film in turn" : "engine and film beside each other"));
    print_elsewhere(scene, plan, cost, list);
}

namespace {

constexpr double usual_lattice = 1e7;  // grain-steps a second: MachineFigures::lattice_one of a usual machine
// Cost of a setting's poster, a picture of its first member's last frame: s of one thread, and bytes.
constexpr double poster_seconds = 0.5, poster_bytes = 0.5e6;

}  // namespace

void StudyEstimate::add_setting(const FilmedScene& scene, const Plan& plan) {
    const ThreadPlan threads{1, 1, 1, true};
    if (settings_.empty()) {
        machine_.lattice_one = machine_.lattice_team = usual_lattice;
        if (measured_) {
            // A team of as many threads as jobs is measured too, for its threads share caches and clock rate
            // as the members will.
            machine_ = machine_figures(scene, plan, {jobs_, 1, 1, true}, films_);
            const int team = std::min(jobs_, machine_.processors);
            side_by_side_ =
                std::clamp(machine_.lattice_team / (machine_.lattice_one * team), 0.3, 1.0) * team / jobs_;
        }
    }
    const std::vector<SegmentCount> film =
        films_ ? count_film(scene, plan.clock, plan.steps) : std::vector<SegmentCount>();
    MemberEstimate member;
    member.seconds = estimate_cost(scene, plan, film, threads, machine_).total_seconds / side_by_side_;
    member.bytes = estimate_disk(scene, plan, frames_of(film)).all();
    settings_.push_back(member);
}

MemberEstimate StudyEstimate::of(const Member& member) const {
    MemberEstimate estimate = settings_.at(member.setting);
    if (member.seed_index == 0) {
        estimate.seconds += poster_seconds;
        estimate.bytes += poster_bytes;
    }
    return estimate;
}

double StudyEstimate::wall_seconds(const std::vector<const Member*>& members) const {
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (int job = 0; job < jobs_; ++job) free_at.push(0);
    double end = 0;
    for (const Member* member : members) {
        const double done = free_at.top() + of(*member).seconds;
        free_at.pop();
        free_at.push(done);
        end = std::max(end, done);
    }
    return end;
}

}  // namespace grainreel

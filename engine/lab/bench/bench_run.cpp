#include "engine/lab/bench/bench_run.hpp"

#include <malloc.h>
#include <time.h>
#include <xxhash.h>
#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/lab/chart/small_world.hpp"

namespace grainreel {

namespace {

constexpr std::int64_t kStepsPerLook = 500;  // steps between two calls of the watcher

double heap_in_use() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

BenchCase shortened(BenchCase bench, std::int64_t times) {
    bench.first_step /= times;
    bench.lead /= times;
    for (BenchPhase& phase : bench.phases) phase.steps /= times;
    return bench;
}

// A bed in motion. The loop refers to the other members, so it must not be copied or moved.
struct Running {
    BenchBed bed;
    Team team;
    std::unique_ptr<StepLoop> loop;
    std::int64_t step = 0;

    Running(BenchBed start, int threads, std::int64_t first)
        : bed(std::move(start)), team(threads), step(first) {
        loop = std::make_unique<StepLoop>(bed.plan, bed.around, bed.grains, team);
        loop->restart();
    }
    double run(std::int64_t steps, double drag = 0) {  // returns the time that it took, in s
        const double begin = seconds();
        loop->run(step, steps, bed.plan.clock.step, drag);
        step += steps;
        return seconds() - begin;
    }
};

class BenchRun {
  public:
    BenchRun(const BenchCase& bench, const BenchRequest& request, const BenchWatcher& watcher)
        : case_(request.quick ? shortened(bench, 10) : bench), request_(request), watcher_(watcher) {
        result_.name = bench.name;
        result_.precision = request.precision;
        result_.threads = request.threads > 0 ? request.threads : usable_processors();
        wanted_ = request.particles > 0 ? request.particles : bench.particles;
        if (case_.side_of_copies)
            while (copies_ * copies_ * bench.particles < wanted_) ++copies_;
        all_steps_ = case_.lead;
        for (const BenchPhase& phase : case_.phases) all_steps_ += phase.steps;
        all_steps_ *= request.repeats;
        case_.bed(case_.particles);  // makes a bed first, because reading a scene takes some memory for good
                                     // (units, keys), which must not count as the bed's
    }

    bool repeat(int repetition) {
        const double before = heap_in_use();
        const int one_copy = copies_ > 1 ? case_.particles : wanted_;
        BenchBed bed = case_.bed(one_copy);
        for (auto* kinds : {&bed.plan.grain, &bed.plan.wall})
            for (PairPlan& pair : *kinds) pair.model.precision = request_.precision;
        Running run(std::move(bed), result_.threads, case_.first_step - case_.lead);
        if (!advance(run, case_.lead, "lead", case_.lead_drag, nullptr)) return false;
        for (std::size_t p = 0; p < case_.phases.size(); ++p) {
            if (repetition == 0) result_.phases.emplace_back().name = case_.phases[p].name;
            if (!time_phase(run, case_.phases[p], result_.phases[p])) return false;
        }
        if (copies_ == 1) note_end(run, heap_in_use() - before);
        return true;
    }

    BenchResult& result() { return result_; }

  private:
    // Many copies of a bed would take too long for a whole phase, so they are made from the bed in the middle
    // of the phase. Once their lists and histories exist, about as many grain-steps are timed as the single
    // bed makes in the phase. A single copy is timed in the same way for comparison.
    bool time_phase(Running& run, const BenchPhase& phase, PhaseResult& result) {
        if (copies_ == 1) return advance(run, phase.steps, phase.name, 0, &result);
        if (!advance(run, phase.steps / 2, phase.name, 0, nullptr)) return false;
        const std::int64_t least = request_.quick ? 100 : 400;
        const std::int64_t steps = std::max(least, phase.steps / (copies_ * copies_)), lead = steps / 2;
        for (int times = 0; times < 5; ++times) {
            Running one = copies_of(run, 1);
            one.run(lead);
            const double work = static_cast<double>(steps) * static_cast<double>(one.bed.grains.size());
            result.of_one_copy.push_back(work / one.run(steps));
        }
        const double before = heap_in_use();
        {
            Running whole = copies_of(run, copies_);
            whole.run(lead);
            if (!advance(whole, steps, phase.name, 0, &result)) return false;
            note_end(whole, heap_in_use() - before);
        }
        return advance(run, phase.steps - phase.steps / 2, phase.name, 0, nullptr);
    }

    Running copies_of(const Running& run, int copies) const {
        return Running(copied(run.bed, run.bed.grains, case_.side_of_copies(run.bed), copies),
                       result_.threads, run.step);
    }

    // Runs so many steps, and times them if `result` is not null. In every fourth stretch of steps the loop's
    // stages are timed too. This slows the loop down, so these stretches do not count for the speed.
    bool advance(Running& run, std::int64_t steps, const std::string& what, double drag,
                 PhaseResult* result) {
        run.loop->clear_costs();
        double taken = 0;
        std::int64_t counted = 0;
        const std::int64_t look = std::min(kStepsPerLook, (steps + 3) / 4);
        for (std::int64_t done = 0, looks = 0; done < steps; ++looks) {
            if (!watcher_(what, std::min(1.0, done_steps_ / static_cast<double>(all_steps_)))) return false;
            const std::int64_t now = std::min(look, steps - done);
            const bool by_stage = result && looks % 4 == 3;
            run.loop->time_costs(by_stage);
            const double time = run.run(now, drag);
            if (!by_stage) taken += time, counted += now;
            done += now;
            done_steps_ += static_cast<double>(now);
        }
        if (result)
            note(run, steps, taken * static_cast<double>(steps) / static_cast<double>(counted), *result);
        return true;
    }

    void note(const Running& run, std::int64_t steps, double taken, PhaseResult& result) {
        const double work = static_cast<double>(steps) * static_cast<double>(run.bed.grains.size());
        result.steps = steps;
        result.particle_steps.push_back(work / taken);
        result.listed = static_cast<std::int64_t>(run.loop->listed_pairs());
        result.touching = 0;
        run.loop->visit_contacts(run.step, [&](const ContactView& c) { result.touching += c.second >= 0; });
        const double thread_time = 1e9 * taken * result_.threads / work;
        const auto shares = run.loop->cost_shares();
        for (int s = 0; s < kCosts; ++s) result.stage[s] = shares[s] * thread_time;
    }

    void note_end(const Running& run, double heap) {
        result_.particles = static_cast<std::int64_t>(run.bed.grains.size());
        result_.bytes_per_particle = heap / static_cast<double>(run.bed.grains.size());
        result_.state_hash = hash_of_motion(run.bed.grains);
    }

    const BenchCase case_;
    const BenchRequest& request_;
    const BenchWatcher& watcher_;
    BenchResult result_;
    int wanted_ = 0, copies_ = 1;
    std::int64_t all_steps_ = 0;
    double done_steps_ = 0;
};

}  // namespace

namespace {

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace

double PhaseResult::median() const {
    return median_of(particle_steps);
}

double PhaseResult::median_of_one_copy() const {
    return median_of(of_one_copy);
}

double PhaseResult::spread() const {
    const auto [low, high] = std::minmax_element(particle_steps.begin(), particle_steps.end());
    return particle_steps.empty() ? 0 : (*high - *low) / median();
}

std::uint64_t hash_of_motion(const Grains& grains) {
    std::vector<std::size_t> by_id(grains.size());
    std::iota(by_id.begin(), by_id.end(), 0);
    std::sort(by_id.begin(), by_id.end(), [&](auto a, auto b) { return grains.id[a] < grains.id[b]; });
    std::vector<Vec3> all;
    for (const std::size_t i : by_id)
        all.insert(all.end(), {grains.place[i].position, grains.motion[i].velocity, grains.motion[i].spin});
    return XXH64(all.data(), all.size() * sizeof(Vec3), 0);
}

BenchOutcome run_bench(const BenchCase& bench, const BenchRequest& request, const BenchWatcher& watcher) {
    BenchRun run(bench, request, watcher);
    BenchOutcome outcome;
    outcome.complete = true;
    for (int r = 0; r < request.repeats && outcome.complete; ++r) outcome.complete = run.repeat(r);
    outcome.result = run.result();
    return outcome;
}

namespace {

constexpr int kSide = 12, kSteps = 40, kStretches = 30;
constexpr double kStep = 1e-9;  // s; nothing moves far, so that every stretch finds the same contacts

Plan lattice_plan() {
    Plan plan;
    PairPlan pair = latching_pair(bench_stiffness, 0.9, 0.5);
    pair.model.normal = NormalForce::walton_braun_corrected;
    plan.grain = plan.wall = {pair};
    plan.clock.step = kStep;
    return plan;
}

Grains lattice_grains() {
    Grains grains;
    const double apart = 2 * bench_radius * (1 - 1e-4);
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y)
            for (int z = 0; z < kSide; ++z) {
                grains.add(static_cast<std::int32_t>(grains.size()), 0, apart * Vec3(x, y, z), bench_radius,
                           bench_density);
                grains.motion.back().velocity = 0.01 * Vec3(y % 2, z % 2, x % 2);
            }
    return grains;
}

// Processor time (s) of all the program's threads.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double lattice_speed(int threads) {
    const Plan plan = lattice_plan();
    Surroundings around;
    around.skin = 0.2 * bench_radius;
    Grains grains = lattice_grains();
    Team team(threads);
    StepLoop loop(plan, around, grains, team);
    loop.restart();
    double best = 0;
    for (int stretch = 0; stretch < kStretches; ++stretch) {
        const double begin = processor_seconds();
        loop.run(stretch * kSteps, kSteps, kStep, 0);
        const double taken = (processor_seconds() - begin) / threads;
        best = std::max(best, kSteps * static_cast<double>(kSide * kSide * kSide) / taken);
    }
    return best;
}

}  // namespace grainreel

// Cases of scenes that are put together at random from all that scenes are made of. They run, their energy
// and their grains add up, one and two threads give the same bits, and a stop in between leaves no trace.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <thread>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "engine/files/measures_csv.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/cli/mesh_scene.hpp"
#include "tests/hard/group.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

// Writes a scene table by table. Lengths are in mm, unless a line says otherwise.
class RandomScene {
  public:
    explicit RandomScene(Dice& dice) : dice_(dice) {
        driven_ = !dice.one_in(3);
        gravity();
        species();
        contact();
        container();
        bodies();
        if (driven_) drive();
        line("[start]\nsettle_limit = \"{} s\"", pick({"0.02", "0.1", "0.3"}));
        if (gravity_ && dice.one_in(3)) line("method = \"rain\"\nrain_rate = 2000");
        traffic();
        run();
        output();
    }
    // `check` draws a picture to tell how long the film takes; here it is a small one.
    std::string text() const { return text_ + "[film]\nsize = \"160x90\"\n"; }

  private:
    template <class... Args>
    void line(fmt::format_string<Args...> form, Args&&... args) {
        text_ += fmt::format(form, std::forward<Args>(args)...) + "\n";
    }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(dice_.below(1001)) / 1000;
    }
    std::string pick(const Names& values) { return dice_.of(values); }

    void gravity() {
        gravity_ = !dice_.one_in(12);
        if (!gravity_)
            line("gravity = 0");
        else if (dice_.one_in(8))
            line("gravity = [0, {:.3g}, -9.6]", between(-2, 2));
        else if (dice_.one_in(8))
            line("gravity = 1.62");
    }

    void species() {
        const std::size_t count = 1 + dice_.below(3);
        for (std::size_t k = 0; k < count; ++k) {
            names_.emplace_back(2, static_cast<char>('a' + k));
            const double d = between(2.5, 7);
            largest_ = std::max(largest_, 1.15 * d);
            line("[[species]]\nname = \"{}\"", names_.back());
            line("count = {}", dice_.one_in(3) ? 1 + dice_.below(6) : 5 + dice_.below(25));
            if (dice_.one_in(3))
                line("diameter = {{ min = \"{:.4g} mm\", max = \"{:.4g} mm\" }}", 0.85 * d, 1.15 * d);
            else if (dice_.one_in(3))
                line("diameter = {{ mean = \"{:.4g} mm\", deviation = \"{:.4g} mm\" }}", d, 0.06 * d);
            else
                line("diameter = \"{:.4g} mm\"", d);
            line("density = {}", pick({"500", "1100", "2500", "7800"}));
        }
    }

    void contact() {
        const std::string law = pick({"walton-braun", "walton-braun", "spring-dashpot", "hertz"});
        const bool walton_braun = law == "walton-braun", smooth = dice_.one_in(6);
        line("[contact]\nlaw = \"{}\"", law);
        line("restitution = {}", pick({"0.3", "0.5", "0.7", "0.9", "0.97"}));
        if (!gravity_) line("{}", law == "hertz" ? "modulus = \"5 MPa\"" : "stiffness = 2e4");
        if (walton_braun && dice_.one_in(4)) line("restitution_speed = 0.5");
        if (!walton_braun && dice_.one_in(4)) line("attraction = true");
        if (smooth) {
            line("friction_law = \"none\"");
        } else {
            line("friction = {}", pick({"0", "0.1", "0.4", "0.9", "inf"}));
            if (dice_.one_in(3)) line("rolling_friction = {}", pick({"0.01", "0.1"}));
            if (walton_braun && dice_.one_in(4)) line("friction_law = \"linear-spring\"");
        }
        if (dice_.one_in(4)) line("[contact.wall]\nrestitution = 0.6{}", smooth ? "" : "\nfriction = 0.2");
        if (!smooth && names_.size() > 1 && dice_.one_in(3))
            line("[[contact.pair]]\nbetween = [\"aa\", \"bb\"]\nfriction = 0.3");
    }

    void container() {
        shape_ = pick({"box", "box", "cylinder", "wedge"});
        const bool cylinder = shape_ == "cylinder";
        height_ = between(70, 120), width_ = between(5, 10) * largest_;
        open_ = dice_.one_in(2);
        line("[container]\nshape = \"{}\"\nheight = \"{:.4g} mm\"\ntop = \"{}\"", shape_, height_,
             open_ ? "open" : "lid");
        if (cylinder) {
            line("diameter = \"{:.4g} mm\"", width_);
        } else {
            line("depth = \"{:.4g} mm\"", between(3.5, 7) * largest_);
            periodic_ = dice_.one_in(3);
            if (periodic_) line("periodic_depth = true");
        }
        if (shape_ == "box") line("width = \"{:.4g} mm\"", width_);
        if (shape_ == "wedge")
            line("half_angle = \"30 deg\"\nhalf_width = \"{:.4g} mm\"\nfloor_width = \"{:.4g} mm\"",
                 width_ / 2, width_ / 2);
        if (dice_.one_in(4)) {
            const bool hole = cylinder || (shape_ == "box" && !periodic_ && dice_.one_in(2));
            line("outlet = {{ {} = \"{:.4g} mm\", opens = \"{} s\", exit_depth = \"{:.4g} mm\" }}",
                 hole ? "diameter" : "width", between(1.2, 2.4) * largest_, pick({"0", "0.02", "0.05"}),
                 2.5 * largest_);
        }
        if (dice_.one_in(4))
            line("wall_grains = {{ species = \"{}\", faces = [{}] }}", pick(names_),
                 cylinder ? pick({"\"floor\"", "\"wall\""})
                 : shape_ == "wedge"
                     ? pick({"\"floor\"", "\"left_slant\"", "\"left_slant\", \"right_slant\""})
                     : pick({"\"floor\"", "\"left_wall\"", "\"floor\", \"right_wall\""}));
    }

    void bodies() {
        if (dice_.one_in(5)) {
            line("[[wall]]\nname = \"ramp\"\npoint = [0, 0, {:.4g}]\nnormal = [0, {:.3g}, 1]",
                 between(0, 0.1) * height_ / 1000, between(-0.4, 0.4));
            if (driven_ && dice_.one_in(2)) line("moves = true");
        }
        if (periodic_ || !dice_.one_in(4)) return;
        const double z = between(0.35, 0.6) * height_ / 1000;  // m
        line("[[mesh]]\nname = \"plate\"\nfile = \"plate.stl\"\nscale = {:.4g}\nposition = [0, 0, {:.4g}]",
             width_ / 300, z);
        if (driven_ && dice_.one_in(3))
            line("driven = true");
        else if (dice_.one_in(2))
            line("turn = {{ axis = [1, 0, 0], through = [0, 0, {:.4g}], rate = \"60 rpm\" }}", z);
        else if (dice_.one_in(3))
            line("velocity = [0, 0, 0.02]");
    }

    void drive() {
        const std::string frequency = pick({"30", "60", "100"});
        // A change takes three periods and begins with a whole one; it must be over before the run's 0.2 s
        // are.
        const std::string from = frequency == "30" ? "0.06" : "0.11";
        line("[drive]\nfrequency = {}\nramp = {}", frequency, frequency == "30" ? "0" : pick({"0", "3"}));
        if (gravity_)
            line("g_level = {}", pick({"0.5", "1.5", "3", "6"}));
        else
            line("amplitude = \"0.3 mm\"");
        if (dice_.one_in(4))
            line("moves = \"floor\"");
        else if (dice_.one_in(4))
            line("direction = [{}, 0.5, 1]", periodic_ ? "0" : "0.3");
        if (!dice_.one_in(3)) return;
        line("[[drive.stage]]\nfrom = \"{} s\"\n{}", from,
             pick({"kind = \"rest\"", "kind = \"taps\"\ninterval = 0.05", "frequency = 80\nover = 3"}));
        stages_ = true;
    }

    void traffic() {
        const double half = 0.0005 * width_;
        if (dice_.one_in(3)) {
            line("[[feed]]\nspecies = \"{}\"\nrate = {}", pick(names_), pick({"30", "100", "300"}));
            if (dice_.one_in(3)) line("from = \"0.03 s\"");
            if (dice_.one_in(3)) line("count = 5");
            if (dice_.one_in(3)) line("velocity = [0, 0.1, -0.3]");
        }
        if (dice_.one_in(4))
            line("[[exit]]\nlow = [-1, {:.4g}, {:.4g}]\nhigh = [1, 1, 1]", between(0, 0.8) * half,
                 dice_.one_in(2) ? -1.0 : between(0, 0.5) * height_ / 1000);
        else if (open_ && dice_.one_in(2))
            line("[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, -0.005]");
    }

    void run() {
        line("[run]\nduration = {}\nseed = {}\naccuracy = \"{}\"", stages_ ? "0.2" : pick({"0.1", "0.15"}),
             dice_.below(1000), dice_.one_in(5) ? "standard" : "draft");
        if (dice_.one_in(6)) line("precision = \"mixed\"");
        if (dice_.one_in(8)) line("integrator = \"leapfrog\"");
    }

    void output() {
        line("[output]\ninstruments = [\"energy_balance\", \"outflow\"{}{}]",
             dice_.one_in(2) ? ", \"walls\"" : "", dice_.one_in(3) ? ", \"bed\", \"surface\"" : "");
        line("measures_interval = \"{} ms\"\ntrajectory_interval = \"{} ms\"", pick({"2", "3", "5"}),
             pick({"5", "7", "10"}));
        if (dice_.one_in(2)) line("contacts = true");
        if (dice_.one_in(2)) line("orientation = true");
        if (dice_.one_in(4))
            line("[output.fields]\ngrid = \"{}\"\nsamples = 4\n{}", shape_ == "cylinder" ? "xyz" : "yz",
                 driven_ ? "periods = 1" : "interval = 0.02");
    }

    Dice& dice_;
    std::string text_, shape_;
    Names names_;
    double largest_ = 0, width_ = 0, height_ = 0;  // mm
    bool gravity_ = true, open_ = false, periodic_ = false, driven_ = false, stages_ = false;
};

nlohmann::json record_of(const fs::path& run) {
    return nlohmann::json::parse(test::text_of(run / "run.json"), nullptr, false);
}

// The energy that a run does not account for, as a share of all that was turned over.
struct EnergyError {
    double share = 0;
    std::string text;  // in J, or which number is none
};

EnergyError energy_error(const fs::path& run) {
    const auto rows = read_measures(run / "measures.csv");
    if (!rows) return {INFINITY, "no measures.csv"};
    double turned = 0, error = 0;
    for (const char* column : {"kinetic_J", "rotational_J", "elastic_J", "wall_work_J", "lost_J"}) {
        double largest = 0;
        for (const double value : rows->all(column)) {
            if (!std::isfinite(value)) return {INFINITY, fmt::format("{} is {}", column, value)};
            largest = std::max(largest, std::abs(value));
        }
        turned += largest;
    }
    for (const double value : rows->all("balance_error_J")) error = std::max(error, std::abs(value));
    return {error > 0 ? error / turned : 0,
            fmt::format("{:.3g} J of {:.3g} J are not accounted for", error, turned)};
}

// What does not add up in the energy of a run, which lies in `here`/whole. Leapfrog's velocities are half a
// step older than its positions, so its balance has an error of first order in the step: it may be larger if
// it shrinks with the step.
std::string imbalance(const Names& movie, const Plan& plan, const fs::path& here) {
    constexpr double most = 0.05, finer = 0.25, shrinks = 0.5;
    const EnergyError whole = energy_error(here / "whole");
    if (whole.share <= most) return "";
    if (plan.integrator != Integrator::leapfrog || !std::isfinite(whole.share)) return whole.text;
    Names again = movie;
    again.back() = "finer";
    again.insert(again.end(), {"--set", fmt::format("run.step={}", finer * plan.clock.step)});
    const Ran ran = attempt(again, here);
    if (!ran.problem.empty() || ran.status != 0) return ran.problem + first_line(ran.err);
    const EnergyError fine = energy_error(here / "finer");
    if (fine.share <= shrinks * whole.share) return "";
    return fmt::format("{}; with a quarter of the step {}", whole.text, fine.text);
}

// Whether grains were lost or invented.
std::string miscount(const fs::path& run, const Scene& scene) {
    const auto lines = [&](const char* file) {
        const std::string text = test::text_of(run / file);
        return std::max<std::int64_t>(std::count(text.begin(), text.end(), '\n') - 1,
                                      0);  // without the header
    };
    const std::int64_t there = lines("final.csv"), left = lines("outflow.csv");
    std::int64_t placed = 0, fed = 0;
    for (const Species& species : scene.species) placed += species.count;
    for (const Feed& feed : scene.feeds) fed += feed.due(scene.run.duration);
    // A feed may be late, if there was no place.
    if (there + left < placed || there + left > placed + fed)
        return fmt::format("{} grains are there and {} have left, of {} and at most {} fed", there, left,
                           placed, fed);
    return "";
}

// The hash of the state at the end, by so many threads.
std::string state_after(const FilmedScene& scene, const Plan& plan, int threads) {
    SimulatedBed bed(scene, plan, threads);
    bed.pack();
    bed.advance(plan.steps);
    return fmt::format("{:016x}", bed.state_hash());
}

// The first file that differs between the two runs.
std::string difference(const fs::path& whole, const fs::path& run) {
    for (const char* file :
         {"trajectory.nc", "measures.csv", "contacts.nc", "fields.nc", "outflow.csv", "final.csv"})
        if (test::text_of(whole / file) != test::text_of(run / file))
            return fmt::format("{} differs after a stop", file);
    return "";
}

// Runs the scene again, stops or kills it at some moment after its first checkpoint, and resumes it.
std::string stopped_and_resumed(const Names& movie, Dice& dice, const fs::path& here, double seconds,
                                bool& over) {
    test::Program program(movie, limits(here));
    test::wait_until(program, [&] { return !program.running() || fs::exists(here / "run/checkpoint.grs"); });
    std::this_thread::sleep_for(
        std::chrono::microseconds(dice.below(1 + static_cast<std::uint64_t>(1e6 * seconds))));
    over = !program.running();
    if (!over) program.send(dice.one_in(2) ? SIGKILL : SIGTERM);
    program.wait();
    const Ran resumed = attempt({"resume", "run"}, here);
    if (!resumed.problem.empty()) return resumed.problem;
    const bool had_ended = resumed.err.find("already") != std::string::npos;
    if (resumed.status != 0 && !had_ended) return "resume: " + first_line(resumed.err);
    over = over || had_ended;
    return difference(here / "whole", here / "run");
}

Outcome random_scene(Dice& dice, const fs::path& here) {
    const RandomScene random(dice);
    const fs::path file = here / "scene.toml";
    test::write_text(file, random.text());
    test::write_text(here / "plate.stl", test::plate_stl);
    const Ran check = attempt({"check", "scene.toml"}, here);
    if (!check.problem.empty()) return {"", check.problem};
    if (check.status != 0) return {"", "is refused: " + first_line(check.err)};
    Names movie{"movie", "scene.toml", "--no-film", "--no-report", "--no-cache", "--out", "whole"};
    const Ran whole = attempt(movie, here);
    if (!whole.problem.empty()) return {"", whole.problem};
    if (whole.err.find("of radius growth") != std::string::npos) return {"does not pack, and says so", ""};
    if (whole.status != 0) return {"", "cannot be run: " + first_line(whole.err)};
    const FilmedScene scene = read_filmed_scene(file, {}, measurable_in);
    const Plan plan = make_plan(scene);
    for (const std::string& wrong : {imbalance(movie, plan, here), miscount(here / "whole", scene)})
        if (!wrong.empty()) return {"", wrong};
    const nlohmann::json record = record_of(here / "whole");
    for (const int threads : {1, 2})
        if (const std::string hash = state_after(scene, plan, threads);
            hash != record["engine"]["state_hash"])
            return {"", fmt::format("another end state on {} threads: {}", threads, hash)};
    movie.back() = "run";
    bool over = false;
    const double seconds = record["wall_s"].value("engine", 0.1);
    const std::string wrong = stopped_and_resumed(movie, dice, here, seconds, over);
    return {over ? "ended before it was stopped" : "stopped and resumed", wrong};
}

}  // namespace

Group random_scenes() {
    return {"random scenes", 300,
            [](int, Dice& dice, const fs::path& here) { return random_scene(dice, here); }, 10, 5};
}

}  // namespace grainreel::hard

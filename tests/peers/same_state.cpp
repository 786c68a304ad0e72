// Our half of the comparison with LAMMPS on one state; tests/peers/same_state.sh says what is compared.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/bench/peers_bed.hpp"
#include "tests/peers/lammps_hooke-inl.hpp"

using namespace grainreel;

namespace {

struct Grain {
    int type = 1;  // 1 small, 2 big
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
};

// By id.
std::vector<Grain> lattice(std::uint32_t seed) {
    const PeersBed bed = peers_bed(seed);
    std::vector<Grain> grains;
    for (const Vec3& x : bed.small_ones) grains.push_back({1, x, Vec3::Zero(), Vec3::Zero()});
    for (const Vec3& x : bed.big_ones) grains.push_back({2, x, Vec3::Zero(), Vec3::Zero()});
    return grains;
}

// The next frame of a dump "id type x y z vx vy vz omegax omegay omegaz"; false at its end.
bool read_frame(std::istream& in, std::int64_t& step, std::vector<Grain>& grains) {
    std::string line;
    std::size_t count = 0;
    while (std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0) {
        if (line == "ITEM: TIMESTEP") in >> step;
        if (line == "ITEM: NUMBER OF ATOMS") in >> count;
    }
    if (!in) return false;
    std::vector<Grain> read(count);
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t id = 0;
        Grain g;
        in >> id >> g.type;
        for (Vec3* v : {&g.position, &g.velocity, &g.spin}) in >> v->x() >> v->y() >> v->z();
        if (!in) throw UserError("the dump ends within a frame");
        read.at(id - 1) = g;
    }
    std::getline(in, line);
    grains = read;
    return true;
}

std::string numbers(const Vec3& v) {
    return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

// A data file for LAMMPS' atom_style sphere.
void write_data(const std::string& path, const std::vector<Grain>& grains) {
    std::string text = fmt::format(
        "bed\n\n{} atoms\n2 atom types\n\n0 0.02 xlo xhi\n0 0.02 ylo yhi\n-0.006 0.1 zlo zhi\n\nAtoms\n\n",
        grains.size());
    for (std::size_t k = 0; k < grains.size(); ++k)
        text += fmt::format("{} {} {} 2500 {}\n", k + 1, grains[k].type,
                            grains[k].type == 1 ? kPeersSmall : kPeersBig, numbers(grains[k].position));
    text += "\nVelocities\n\n";
    for (std::size_t k = 0; k < grains.size(); ++k)
        text += fmt::format("{} {} {}\n", k + 1, numbers(grains[k].velocity), numbers(grains[k].spin));
    replace_file(path, text);
}

enum class Conventions { ours, lammps };

// The bed in our engine, over a floor that stands still.
class Bed {
  public:
    Bed(const std::vector<Grain>& from, Conventions conventions) {
        plan_ = peers_plan();
        if (conventions == Conventions::lammps) {
            law_.at_mid_step = false;
            plan_.arms = LeverArms::radius;
            for (auto* kinds : {&plan_.grain, &plan_.wall})
                for (PairPlan& pair : *kinds) pair.model.own = &law_;
        }
        around_ = peers_surroundings({}, plan_);
        for (std::size_t k = 0; k < from.size(); ++k) {
            const double diameter = from[k].type == 1 ? kPeersSmall : kPeersBig;
            grains_.add(static_cast<std::int32_t>(k), from[k].type - 1, from[k].position - corner,
                        diameter / 2, 2500);
            grains_.motion.back().velocity = from[k].velocity;
            grains_.motion.back().spin = from[k].spin;
        }
        loop_ = std::make_unique<StepLoop>(plan_, around_, grains_, team_);
        loop_->restart();
    }
    void run(std::int64_t count) {
        loop_->run(at_, count, plan_.clock.step, 0);
        at_ += count;
    }
    // m, the largest distance of a grain from where it is in `other`.
    double farthest_from(const std::vector<Grain>& other) const {
        double farthest = 0;
        for (std::size_t i = 0; i < grains_.size(); ++i) {
            const Vec3 there = other[grains_.id[i]].position - corner;
            farthest = std::max(farthest, (grains_.place[i].position - there).norm());
        }
        return farthest;
    }
    double mean_height() const {
        double sum = 0;
        for (const Place& p : grains_.place) sum += p.position.z();
        return sum / static_cast<double>(grains_.size());
    }
    // Grains that touch a grain, on average.
    double contacts() const {
        std::int64_t pairs = 0;
        loop_->visit_contacts(at_, [&](const ContactView& c) { pairs += c.second >= 0; });
        return 2.0 * static_cast<double>(pairs) / static_cast<double>(grains_.size());
    }

  private:
    using Lanes = HWY_NAMESPACE::Lanes;
    using LammpsLaw = HWY_NAMESPACE::LammpsHooke;
    inline static const Vec3 corner{0.01, 0.01, 0};
    static constexpr std::int64_t long_before = -1000000000;  // the floor moves from step 0 on

    LawKernel law_ = HWY_NAMESPACE::kernel_of<LammpsLaw, Lanes>();
    Plan plan_;
    Surroundings around_;
    Grains grains_;
    Team team_{1};
    std::unique_ptr<StepLoop> loop_;
    std::int64_t at_ = long_before;
};

// Ours from the first frame of a dump against its later ones: step, and the largest distance with LAMMPS'
// conventions and with our own.
void compare(const std::string& dump, const std::string& table) {
    std::ifstream in(dump);
    std::int64_t step = 0, before = 0;
    std::vector<Grain> frame;
    if (!read_frame(in, before, frame)) throw UserError(dump + ": no frames");
    Bed theirs(frame, Conventions::lammps), ours(frame, Conventions::ours);
    std::string text = "step,lammps_conventions_m,own_scheme_m\n";
    while (read_frame(in, step, frame)) {
        theirs.run(step - before), ours.run(step - before);
        before = step;
        text +=
            fmt::format("{},{:.4g},{:.4g}\n", step, theirs.farthest_from(frame), ours.farthest_from(frame));
    }
    replace_file(table, text);
    fmt::print("{}", text);
}

// Mean height and contacts a grain over the last sixth of a run.
void settle(std::uint32_t seed, std::int64_t steps) {
    Bed bed(lattice(seed), Conventions::ours);
    constexpr std::int64_t samples = 10;
    bed.run(steps - steps / 6);
    double height = 0, contacts = 0;
    for (std::int64_t k = 0; k < samples; ++k) {
        bed.run(steps / 6 / samples);
        height += bed.mean_height() / samples, contacts += bed.contacts() / samples;
    }
    fmt::print("{:.8g} {:.6g}\n", height, contacts);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto number = [&](std::size_t k) { return std::strtoul(words.at(k).c_str(), nullptr, 10); };
    try {
        const std::string verb = words.empty() ? "" : words[0];
        if (verb == "lattice" && words.size() == 3) {
            write_data(words[2], lattice(static_cast<std::uint32_t>(number(1))));
        } else if (verb == "state" && words.size() == 3) {
            std::ifstream in(words[1]);
            std::int64_t step = 0;
            std::vector<Grain> frame;
            while (read_frame(in, step, frame)) {
            }
            if (frame.empty()) throw UserError(words[1] + ": no frames");
            write_data(words[2], frame);
        } else if (verb == "compare" && words.size() == 3) {
            compare(words[1], words[2]);
        } else if (verb == "settle" && words.size() == 3) {
            settle(static_cast<std::uint32_t>(number(1)), static_cast<std::int64_t>(number(2)));
        } else {
            fmt::print(stderr,
                       "same_state lattice SEED DATA | state DUMP DATA | compare DUMP TABLE | settle SEED "
                       "STEPS\n");
            return 2;
        }
    } catch (const std::exception& failure) {
        fmt::print(stderr, "same_state: {}\n", failure.what());
        return 1;
    }
    return 0;
}

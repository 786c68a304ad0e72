#include "engine/start/restart.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"

namespace grainreel {

namespace {

constexpr char kMagic[8] = {'g', 'r', 'a', 'i', 'n', 'r', 's', '8'};

// What must be equal for a continuation to be the same run: laws, stiffness, step, drive.
std::uint64_t plan_fingerprint(const Scene& scene, const Plan& plan) {
    std::ostringstream out;
    write_value(out, plan.arms);
    write_value(out, plan.integrator);
    for (const auto* table : {&plan.grain, &plan.wall}) {
        for (const PairPlan& p : *table) {
            write_value(out, p.model.normal);
            write_value(out, p.model.tangential);
            write_value(out, p.model.rolls);
            write_value(out, p.model.precision);
            for (const double v :
                 {p.loading_stiffness, p.unloading_stiffness, p.hardening, p.modulus, p.tangential_stiffness,
                  p.tangential_ratio, p.gamma, p.friction, p.rolling_friction, p.normal_damping,
                  p.tangential_damping, p.hertz_damping, p.attraction ? 1.0 : 0.0}) {
                write_value(out, v);
            }
            write_vector(out, p.restitution_table);
        }
    }
    write_value(out, plan.clock.step);
    write_value(out, plan.clock.steps_per_period);
    for (const double v :
         {scene.drive.frequency, scene.drive.amplitude, scene.drive.phase, scene.drive.ramp}) {
        write_value(out, v);
    }
    for (const double v : {scene.gravity.x(), scene.gravity.y(), scene.gravity.z()}) write_value(out, v);
    const std::string bytes = out.str();
    return XXH64(bytes.data(), bytes.size(), 0);
}

template <class Grain, class Each>
void transfer_grains(Grain& g, const Each& each) {
    each(g.id), each(g.species), each(g.place), each(g.motion), each(g.load);
    each(g.wall_work), each(g.orientation), each(g.derivatives);
}

UserError cannot_start(const Scene& scene, const std::string& what) {
    return UserError(fmt::format("{}: '{}' {}", scene.where("start.file"), scene.start.file, what));
}

std::string read_whole(const Scene& scene) {
    std::ifstream in(scene.start.file, std::ios::binary);
    if (!in)
        throw cannot_start(scene, "cannot be read; give the checkpoint.grs or final.csv of an earlier run");
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
}

}  // namespace

void write_state(std::ostream& out, std::int64_t step, const Grains& grains, const StepLoop& loop) {
    write_value(out, step);
    transfer_grains(grains, Writing{out});
    loop.save(out);
}

void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop) {
    std::ostringstream body;
    write_value(body, plan_fingerprint(scene, plan));
    write_value(body, header);
    write_state(body, header.step, grains, loop);
    const std::string bytes = body.str();
    const std::uint64_t sum = XXH64(bytes.data(), bytes.size(), 0);

    const std::filesystem::path temporary = path.string() + ".part";
    std::ofstream file(temporary, std::ios::binary);
    file.write(kMagic, sizeof kMagic);
    write_value(file, sum);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code failed;
    if (file) std::filesystem::rename(temporary, path, failed);
    if (!file || failed) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw RunError(fmt::format("{}: the checkpoint cannot be written; is the disk full?", path.string()));
    }
}

bool is_checkpoint(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    char magic[sizeof kMagic] = {};
    in.read(magic, sizeof magic);
    return in && std::memcmp(magic, kMagic, sizeof magic) == 0;
}

CheckpointHeader load_checkpoint(const Scene& scene, const Plan& plan, Grains& grains, StepLoop* loop) {
    const std::string bytes = read_whole(scene);
    constexpr std::size_t prologue = sizeof kMagic + sizeof(std::uint64_t);
    std::uint64_t sum = 0;
    if (bytes.size() > prologue) std::memcpy(&sum, bytes.data() + sizeof kMagic, sizeof sum);
    if (bytes.size() <= prologue || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0 ||
        sum != XXH64(bytes.data() + prologue, bytes.size() - prologue, 0)) {
        throw cannot_start(scene, "is damaged or no checkpoint of this version; take another");
    }
    std::istringstream in(bytes.substr(prologue));
    std::uint64_t fingerprint = 0;
    CheckpointHeader header;
    std::int64_t step = 0;
    read_value(in, fingerprint);
    if (loop && fingerprint != plan_fingerprint(scene, plan)) {
        throw cannot_start(
            scene,
            "was made with other laws, stiffness, step or drive; "
            "use the same scene, or set start.keep_clock = false to start anew from its grains");
    }
    read_value(in, header);
    read_value(in, step);
    transfer_grains(grains, Reading{in});
    if (loop) loop->load(in);
    if (!in) throw cannot_start(scene, "is damaged; take another checkpoint");
    return header;
}

}  // namespace grainreel

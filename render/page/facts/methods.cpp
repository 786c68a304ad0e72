#include "render/page/facts/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <filesystem>
#include <numbers>
#include <set>

#include "engine/files/folder_lock.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

ReadRunJson record_of_page(const std::filesystem::path& folder) {
    ReadRunJson run = read_run_json(folder / "run.json");
    if (run.status.empty()) run.status = "unknown";
    if (lacks_only_page(run.record)) run.status = to_string(RunStatus::complete);
    if (run.status == to_string(RunStatus::running) && !FolderLock::holder(folder)) run.status = "broken off";
    return run;
}

namespace {

std::string hash_text(const RunJson& record) {
    return record.state_hash ? fmt::format("{:016x}", *record.state_hash) : "";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> origin_lines(const ReadRunJson& run) {
    const RunJson& record = run.record;
    const bool computed = record.step > 0;  // else the file tells nothing about the engine
    std::vector<std::pair<std::string, std::string>> lines;
    const auto line = [&](const char* name, const std::string& words) {
        if (!words.empty()) lines.emplace_back(name, words);
    };
    line("status", run.status);
    line("error", record.error);
    line("command", record.command);
    line("scene file", record.scene_file);
    line("program",
         "grainreel " + record.version + (record.commit.empty() ? "" : ", commit " + record.commit));
    line("compiler", record.compiler);
    if (computed) line("seed", fmt::format("{}", record.seed));
    if (computed) line("step (s)", fmt::format("{}", record.step));
    if (computed) line("steps", fmt::format("{}", record.steps));
    if (computed) line("engine threads", fmt::format("{}", record.engine_threads));
    line("vector instructions", record.vector);
    line("hash of the end state", hash_text(record));
    line("started", record.started);
    line("finished", record.finished);
    line("film encoded by", record.encoder);
    line("film drawn by", record.gl);
    return lines;
}

namespace {

// A source with its key in docs/reference/theory.md and its BibTeX entry.
struct Source {
    const char* key;
    const char* entry;
};
constexpr Source sources[] = {
    {"Cundall1979",
     "@article{Cundall1979,\n  author = {Cundall, P. A. and Strack, O. D. L.},\n"
     "  title = {A discrete numerical model for granular assemblies},\n  journal = {G{\\'e}otechnique},\n"
     "  volume = {29},\n  pages = {47--65},\n  year = {1979},\n  doi = {10.1680/geot.1979.29.1.47}\n}\n"},
    {"Walton1986",
     "@article{Walton1986,\n  author = {Walton, O. R. and Braun, R. L.},\n"
     "  title = {Viscosity, granular-temperature, and stress calculations for shearing assemblies of "
     "inelastic, "
     "frictional disks},\n  journal = {Journal of Rheology},\n  volume = {30},\n  pages = {949--980},\n"
     "  year = {1986},\n  doi = {10.1122/1.549893}\n}\n"},
    {"Walton1993",
     "@incollection{Walton1993,\n  author = {Walton, O. R.},\n"
     "  title = {Numerical simulation of inelastic, frictional particle-particle interactions},\n"
     "  booktitle = {Particulate Two-Phase Flow},\n  editor = {Roco, M. C.},\n  chapter = {25},\n"
     "  publisher = {Butterworth-Heinemann},\n  year = {1993}\n}\n"},
    {"Schwager2007",
     "@article{Schwager2007,\n  author = {Schwager, T. and P{\\\"o}schel, T.},\n"
     "  title = {Coefficient of restitution and linear-dashpot model revisited},\n"
     "  journal = {Granular Matter},\n  volume = {9},\n  pages = {465--469},\n  year = {2007},\n"
     "  doi = {10.1007/s10035-007-0065-z}\n}\n"},
    {"Tsuji1992",
     "@article{Tsuji1992,\n  author = {Tsuji, Y. and Tanaka, T. and Ishida, T.},\n"
     "  title = {Lagrangian numerical simulation of plug flow of cohesionless particles in a horizontal "
     "pipe},\n"
     "  journal = {Powder Technology},\n  volume = {71},\n  pages = {239--250},\n  year = {1992},\n"
     "  doi = {10.1016/0032-5910(92)88030-L}\n}\n"},
    {"Thornton2013",
     "@article{Thornton2013,\n  author = {Thornton, C. and Cummins, S. J. and Cleary, P. W.},\n"
     "  title = {An investigation of the comparative behaviour of alternative contact force models during "
     "inelastic collisions},\n  journal = {Powder Technology},\n  volume = {233},\n  pages = {30--46},\n"
     "  year = {2013}\n}\n"},
    {"Iwashita1998",
     "@article{Iwashita1998,\n  author = {Iwashita, K. and Oda, M.},\n"
     "  title = {Rolling resistance at contacts in simulation of shear band development by {DEM}},\n"
     "  journal = {Journal of Engineering Mechanics},\n  volume = {124},\n  pages = {285--292},\n"
     "  year = {1998}\n}\n"},
};

// Writes a clause for each law of the plan's contacts, with the keys of its sources.
class LawWords {
  public:
    explicit LawWords(const Plan& plan) {
        for (const std::vector<PairPlan>* pairs : {&plan.grain, &plan.wall, &plan.mesh})
            for (const PairPlan& pair : *pairs) take(pair);
        if (plan.rolls()) {
            words_.insert("rolling meets a spring with a cap [Iwashita1998]");
            keys.insert("Iwashita1998");
        }
    }
    std::string text() const { return fmt::format("{}", fmt::join(words_, "; ")); }
    std::set<std::string> keys{"Cundall1979"};

  private:
    void note(const char* words, const char* key) {
        words_.insert(fmt::format("{} [{}]", words, key));
        keys.insert(key);
    }
    void take(const PairPlan& pair) {
        switch (pair.model.normal) {
            case NormalForce::spring_dashpot:
                note("the normal force is a linear spring and dashpot", "Schwager2007");
                break;
            case NormalForce::hertz:
                note("the normal force is that of Hertz with a dashpot", "Tsuji1992");
                break;
            default:
                note("the normal force is Walton and Braun's latching spring", "Walton1986");
        }
        switch (pair.model.tangential) {
            case TangentialLaw::incremental_slip:
                note("friction is Walton's incremental slip", "Walton1993");
                break;
            case TangentialLaw::linear_spring:
                note("friction is a linear spring with Coulomb's cap", "Cundall1979");
                break;
            case TangentialLaw::mindlin:
                note("friction is Mindlin's spring with Coulomb's cap", "Thornton2013");
                break;
            case TangentialLaw::none:
                break;
        }
    }
    std::set<std::string> words_;
};

const char* name_of(Integrator integrator) {
    switch (integrator) {
        case Integrator::velocity_verlet:
            return "the velocity Verlet scheme";
        case Integrator::leapfrog:
            return "the leapfrog scheme";
        case Integrator::position_verlet:
            return "the position Verlet scheme";
        case Integrator::forest_ruth:
            return "the scheme of Forest and Ruth";
        case Integrator::gear:
            break;
    }
    return "Gear's predictor-corrector scheme";
}

// The texts of the line with that name and of the nameless lines that continue it.
std::string words_of(const std::vector<std::pair<std::string, std::string>>& lines, const std::string& name) {
    std::vector<std::string> texts;
    bool inside = false;
    for (const auto& [line, text] : lines) {
        inside = line == name || (inside && line.empty());
        if (inside) texts.push_back(text);
    }
    return fmt::format("{}", fmt::join(texts, "; "));
}

// The range of a value over all kinds of contact, as text: "0.3" or "0.3 to 0.8".
template <class Value>
std::string range_text(const Plan& plan, const Value& value) {
    std::vector<double> values;
    for (const std::vector<PairPlan>* pairs : {&plan.grain, &plan.wall, &plan.mesh})
        for (const PairPlan& pair : *pairs) values.push_back(value(pair));
    if (values.empty()) return "-";
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *low == *high ? fmt::format("{:.3g}", *low) : fmt::format("{:.3g} to {:.3g}", *low, *high);
}

// The meshes in words: "drum (drum.stl, 720 triangles, XXH64 0123456789abcdef)".
std::string meshes_text(const FilmedScene& scene) {
    std::vector<std::string> texts;
    for (const SceneMesh& mesh : scene.meshes)
        texts.push_back(fmt::format(
            "{} ({}, {} triangles{})", mesh.name, std::filesystem::path(mesh.file).filename().string(),
            mesh.shape().triangles.size(), mesh.hash.empty() ? "" : ", XXH64 " + mesh.hash));
    return fmt::format("{}", fmt::join(texts, ", "));
}

// "7.432 \u00b5s": four digits in a unit in which they stand before the point.
std::string step_text(double seconds) {
    const std::pair<const char*, double> units[] = {{"s", 1}, {"ms", 1e-3}, {"\u00b5s", 1e-6}, {"ns", 1e-9}};
    for (const auto& [unit, size] : units)
        if (seconds >= 0.5 * size) return fmt::format("{:.4g} {}", seconds / size, unit);
    return fmt::format("{:.4g} s", seconds);
}

std::string program_entry(const RunJson& record) {
    const std::string& time = record.finished.empty() ? record.started : record.finished;
    return fmt::format(
        "@software{{grainreel,\n  author = {{{{The grainreel authors}}}},\n  title = {{grainreel}},\n"
        "  version = {{{}{}}},\n  year = {{{}}}\n}}\n",
        record.version, record.commit.empty() ? "" : ", commit " + record.commit, time.substr(0, 4));
}

}  // namespace

Methods methods(const FilmedScene& scene, const Plan& plan, const RunJson& record,
                const std::vector<std::pair<std::string, std::string>>& lines, const std::string& seeds) {
    const LawWords laws(plan);
    Methods result;
    result.paragraph = fmt::format(
        "The bed was computed by the discrete element method [Cundall1979] with grainreel {} [grainreel]. "
        "Grains: {}. "
        "Container: {}. Gravity: {}. Drive: {}. In contacts {}. The restitution is {}, the coefficient of "
        "friction "
        "{}. Start: {}. Equations of motion were integrated by {} with a step of {}, {} steps for {:.6g} s. "
        "Random "
        "numbers have the {}.",
        record.version, words_of(lines, "grains"), words_of(lines, "container"), words_of(lines, "gravity"),
        words_of(lines, "drive"), laws.text(),
        range_text(plan, [](const PairPlan& pair) { return pair.restitution; }),
        range_text(plan, [](const PairPlan& pair) { return pair.friction; }), words_of(lines, "start"),
        name_of(plan.integrator), step_text(plan.clock.step), plan.steps, scene.run.duration,
        seeds.empty() ? fmt::format("seed {}", scene.run.seed) : seeds);
    if (!scene.meshes.empty())
        result.paragraph += fmt::format(
            " Walls from triangle meshes: {}. A grain has one contact with each connected patch of a surface "
            "that it "
            "touches, at the nearest point of its faces, edges and corners; triangles that turn by less than "
            "{:.3g} "
            "degrees from their neighbours are one patch. Of two places whose normals differ by less, in one "
            "mesh or in two, the nearer one counts, and what lies behind a wall is not touched.",
            meshes_text(scene), kSmoothAngle * 180 / std::numbers::pi);
    if (record.state_hash)
        result.paragraph += fmt::format(" The hash of the end state is {}.", hash_text(record));
    result.bibtex = program_entry(record);
    for (const Source& source : sources)
        if (laws.keys.count(source.key) > 0) result.bibtex += source.entry;
    return result;
}

}  // namespace grainreel

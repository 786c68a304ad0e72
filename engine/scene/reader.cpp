#include "engine/scene/reader.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/scene/reader_parts.hpp"

namespace grainreel {
namespace {

std::string load(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        throw UserError(
            fmt::format("{}: this is a folder; give the path of a scene file (.toml)", file.string()));
    if (!std::filesystem::exists(file, ignored))
        throw UserError(
            fmt::format("{}: there is no such file; give the path of a scene file (.toml)", file.string()));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw UserError(fmt::format("{}: cannot be read; check its permissions", file.string()));
    return text.str();
}

void read_gravity(Document& document, Scene& scene) {
    if (document.is_array("gravity")) {
        scene.gravity = *document.vector("gravity");
    } else if (const auto downwards = document.quantity("gravity")) {
        scene.gravity = Vec3(0, 0, *downwards == 0 ? 0 : -*downwards);
    }
}

// Corrections need a spring of constant slopes.
void check_correctable(const Document& document, const Contact& contact) {
    const auto check = [&](const PairContact& pair) {
        if (pair.normal == NormalLaw::walton_braun && !pair.restitution_speed &&
            pair.restitution_table.empty())
            return;
        document.fail("run.contact_corrections",
                      "is made for the law walton-braun with a restitution that is "
                      "the same at any speed; remove it");
    };
    for (const PairContact& pair : contact.grain) check(pair);
    for (const PairContact& pair : contact.wall) check(pair);
}

void read_run(Document& document, Scene& scene) {
    Run& run = scene.run;
    run.duration = document.quantity("run.duration").value_or(run.duration);
    run.seed = static_cast<std::uint64_t>(document.integer("run.seed").value_or(1));
    run.threads = static_cast<int>(document.integer("run.threads").value_or(run.threads));
    run.step = document.quantity("run.step");
    run.accuracy = chosen<Accuracy>(
        document, "run.accuracy",
        {{"draft", Accuracy::draft}, {"standard", Accuracy::standard}, {"reference", Accuracy::reference}},
        Accuracy::standard);
    if (run.accuracy == Accuracy::draft) run.overlap = 0.02;
    if (run.accuracy == Accuracy::reference) run.overlap = 0.003;
    run.overlap = document.quantity("run.overlap").value_or(run.overlap);
    if (const auto steps = document.integer("run.steps_per_contact"))
        run.steps_per_contact = static_cast<int>(*steps);
    run.integrator = chosen<Integrator>(document, "run.integrator",
                                        {{"velocity-verlet", Integrator::velocity_verlet},
                                         {"leapfrog", Integrator::leapfrog},
                                         {"position-verlet", Integrator::position_verlet},
                                         {"forest-ruth", Integrator::forest_ruth},
                                         {"gear", Integrator::gear}},
                                        Integrator::velocity_verlet);
    run.contact_corrections = document.flag("run.contact_corrections").value_or(run.contact_corrections);
    if (run.contact_corrections && run.integrator != Integrator::velocity_verlet)
        document.fail("run.contact_corrections", "is made for velocity-verlet; remove it or the integrator");
    if (run.contact_corrections) check_correctable(document, scene.contact);
    if (run.step) document.refuse("run.steps_per_contact", "'step' is given");
}

void read_output(Document& document, Scene& scene) {
    Output& output = scene.output;
    output.trajectory = document.flag("output.trajectory").value_or(output.trajectory);
    if (!output.trajectory) {
        document.refuse("output.trajectory_interval", "no trajectory is kept");
        document.refuse("output.orientation", "no trajectory is kept");
    }
    output.trajectory_interval = document.quantity("output.trajectory_interval");
    output.measures_interval = document.quantity("output.measures_interval");
    output.orientation = document.flag("output.orientation").value_or(output.orientation);
    output.contacts = document.flag("output.contacts").value_or(output.contacts);
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& sets) {
    return read_scene_text(load(file), file, sets);
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file,
                      const std::vector<std::string>& sets) {
    Document document(text, file.string());
    for (const std::string& assignment : sets) document.set(assignment);
    document.check_keys();

    Scene scene;
    scene.name = file.stem().string();
    scene.file = file.string();
    scene.written = document.written();
    scene.title = document.text("title").value_or(scene.name);
    read_gravity(document, scene);
    read_species(document, scene);
    read_contact(document, scene);
    read_container(document, scene);
    read_exact(document, scene);
    read_drive(document, scene);
    read_start(document, scene);
    read_run(document, scene);
    read_output(document, scene);
    read_film(document, scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    return scene;
}

}  // namespace grainreel

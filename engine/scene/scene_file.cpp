#include "engine/scene/scene_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_of_a_path = 400;  // characters of a path in a message

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw UserError("{}: {}", excerpt(file.string(), most_of_a_path), what);
}

std::string advice_for_missing(const std::filesystem::path& file) {
    std::string several;
    for (const ShippedScene* scene : shipped_scenes_with(file.filename().string()))
        several += (several.empty() ? "" : ", ") + scene->name;
    if (!several.empty()) return "several shipped scenes have this in their names: " + several;
    const std::optional<std::string> meant = nearest_shipped_scene(file.filename().string());
    return meant ? fmt::format("did you mean the shipped scene '{}'?", *meant)
                 : "give the path of a scene file (.toml)";
}

// Returns whether the file is a pipe. Throws if it cannot be read.
bool check_kind(const std::filesystem::path& file, Pipes pipes) {
    using Type = std::filesystem::file_type;
    std::error_code ignored;
    switch (std::filesystem::status(file, ignored).type()) {
        case Type::regular:
            return false;
        case Type::fifo:
            if (pipes == Pipes::taken) return true;
            fail(file, "this is a pipe; give the path of an ordinary file");
        case Type::directory:
            fail(file, "this is a folder; give the path of a scene file (.toml)");
        case Type::not_found:
            fail(file, "there is no such file; " + advice_for_missing(file));
        case Type::none:
        case Type::unknown:
            fail(file, "cannot be read; check its permissions");
        default:
            fail(file, "this is a device; give the path of a scene file (.toml)");
    }
}

struct Closing {
    int file;
    ~Closing() { ::close(file); }
};

// Waits until something comes through the pipe, or until it ends. A signal to stop the program ends the wait.
void wait_for(const std::filesystem::path& file, int pipe) {
    pollfd waiting{pipe, POLLIN, 0};
    if (::poll(&waiting, 1, -1) < 0) fail(file, "this is a pipe, and waiting for it was stopped");
}

}  // namespace

std::string load_scene_file(const std::filesystem::path& file, Pipes pipes) {
    const bool pipe = check_kind(file, pipes);
    const int open = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (open < 0) fail(file, "cannot be read; check its permissions");
    const Closing closing{open};
    std::string text;
    char part[1 << 16];
    while (true) {
        if (pipe) wait_for(file, open);
        const ssize_t got = ::read(open, part, sizeof part);
        if (got == 0) return text;
        if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
        if (got < 0) fail(file, "cannot be read; check its permissions");
        text.append(part, static_cast<std::size_t>(got));
        if (text.size() > largest_scene_file)
            fail(file,
                 fmt::format("is larger than the {} MiB that a scene may have; give the path of a scene "
                             "file (.toml)",
                             largest_scene_file >> 20));
    }
}

namespace {

// Checks the file's name, which becomes the film's title and the folder's name when the scene has no other.
void check_name(const std::filesystem::path& file) {
    const std::string wrong = complaint_of_utf8(file.filename().string());
    if (!wrong.empty()) throw UserError("{}; rename the file", wrong);
    if (const auto control = first_control_character(file.filename().string()))
        throw UserError("{}: the file's name holds the control character U+{:04X}; rename it", file.string(),
                        *control);
}

// Refuses a study, which names a scene and is no scene itself.
void check_no_study(const Document& document, const std::filesystem::path& file) {
    const bool varies =
        document.has("vary") || document.has("variant") || document.has("measure") || document.has("seeds");
    if (varies && document.is_text("scene"))
        fail(file, fmt::format("this is a study, not a scene; run it by: {} study {}", program_call(),
                               shell_word(file.string())));
}

void check_instruments(const Document& document, const Scene& scene) {
    const std::vector<std::string>& known = scene.measurable.instruments;
    for (const std::string& name : scene.output.instruments)
        if (!contains(known, name))
            document.fail("output.instruments",
                          fmt::format("names \"{}\", which is no instrument; there is {}", excerpt(name),
                                      fmt::join(known, ", ")));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Assignments& sets, const MeasurableIn& measurable) {
    Scene scene;
    read_scene_into(scene, text_of_scene(file), sets, measurable);
    return scene;
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets,
                      const MeasurableIn& measurable) {
    Scene scene;
    read_scene_into(scene, {std::string(text), file}, sets, measurable);
    return scene;
}

NamedText text_of_scene(const std::filesystem::path& file) {
    if (!file.has_parent_path() && !is_there(file))
        if (const ShippedScene* shipped = shipped_scene_like(file.string()))
            return {std::string(shipped->text), shipped->name + ".toml"};
    return {load_scene_file(file, Pipes::taken), file};
}

void read_scene_into(Scene& scene, const NamedText& from, const Assignments& sets,
                     const MeasurableIn& measurable, TableReader* further) {
    check_name(from.file);
    Document document(from.text, from.file.string(), further != nullptr ? further->keys() : scene_keys());
    check_no_study(document, from.file);
    for (const Assignment& assignment : sets) document.set(assignment);
    if (further == nullptr) scene.film_text = document.take_out("film");
    document.check_keys();

    scene.name = from.file.stem().string();
    scene.file = from.file.string();
    scene.written = document.written();
    // The order matters: a reader may use what those before it have read, such as species and meshes.
    read_top_level(document, scene);
    read_species(document, scene, further);
    read_meshes(document, scene);
    read_contact(document, scene);
    read_container(document, scene);
    read_walls(document, scene);
    read_exits(document, scene);
    read_feeds(document, scene);
    read_grains(document, scene);
    read_drive(document, scene);
    read_start(document, scene);
    read_run(document, scene);
    shorten(document, scene);
    count_fed(document, scene);
    read_fields(document, scene);
    if (measurable) scene.measurable = measurable(scene);
    check_instruments(document, scene);
    if (further != nullptr) further->read_tables(document);
    measure_meshes(scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    for (std::string& doubt : doubts_of_meshes(scene)) scene.notes.push_back(std::move(doubt));
    if (further != nullptr) further->check();
}

// The order of the lists is that of docs/reference/scenes.md.
const std::vector<Key>& scene_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
        list_top_level(all);
        list_species(all);
        list_contact(all);
        list_container(all);
        list_walls(all);
        list_meshes(all);
        list_exits(all);
        list_grains(all);
        list_drive(all);
        list_start(all);
        list_run(all);
        list_feeds(all);
        return all;
    }();
    return keys;
}

std::string written_scene(const Scene& scene, const Reasons& reasons) {
    SceneText out;
    out.comment("Every value as it was used, in SI units; phases in turns, the camera in degrees.");
    write_top_level(out, scene);
    write_species(out, scene);
    write_contact(out, scene, reasons);
    write_container(out, scene);
    write_walls(out, scene);
    write_meshes(out, scene);
    write_exits(out, scene);
    write_grains(out, scene);
    write_feeds(out, scene);
    write_drive(out, scene);
    write_start(out, scene);
    write_run(out, scene, reasons);
    return out.take() + scene.film_text;
}

namespace fs = std::filesystem;

namespace {

std::string name_for(const fs::path& file, const std::vector<KeptFile>& taken) {
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(taken.begin(), taken.end(), [&](const KeptFile& one) { return one.name == name; });
    };
    const std::string stem = file.stem().string(), end = file.extension().string();
    std::string name = fmt::format("{}/{}{}", kMeshFolder, stem, end);
    for (int number = 2; is_taken(name); ++number)
        name = fmt::format("{}/{}-{}{}", kMeshFolder, stem, number, end);
    return name;
}

// Adds a file to the kept ones and returns the name that it has there.
std::string keep(const std::string& file, const std::string& hash, std::vector<KeptFile>& kept) {
    const fs::path path = file;
    if (file.empty() || path.filename().string().starts_with("shipped:")) return file;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const KeptFile& one) {
        return one.hash == hash && fs::path(one.from).filename() == path.filename();
    });
    if (same != kept.end()) return same->name;
    kept.push_back({file, hash, name_for(path, kept)});
    return kept.back().name;
}

}  // namespace

std::vector<KeptFile> kept_files(const Scene& scene) {
    std::vector<KeptFile> kept;
    for (const SceneMesh& mesh : scene.meshes) {
        keep(mesh.file, mesh.hash, kept);
        keep(mesh.path_file, mesh.path_hash, kept);
    }
    return kept;
}

Scene naming_kept_files(Scene scene) {
    std::vector<KeptFile> kept;
    for (SceneMesh& mesh : scene.meshes) {
        mesh.file = keep(mesh.file, mesh.hash, kept);
        mesh.path_file = keep(mesh.path_file, mesh.path_hash, kept);
    }
    return scene;
}

}  // namespace grainreel

// The verb `new` writes a scene file to start from.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_scene = "gravel";
constexpr const char* schema_name = "grainreel.schema.json";

const ShippedScene& scene_called(const std::string& name) {
    if (const ShippedScene* scene = shipped_scene_like(name)) return *scene;
    std::vector<std::string> names;
    for (const ShippedScene& scene : shipped_scenes()) names.push_back(scene.name);
    const std::optional<std::string> meant = nearest_shipped_scene(name);
    throw UserError("--from: there is no single scene like '{}'; {}there are {}", excerpt(name),
                    meant ? fmt::format("did you mean '{}'? ", *meant) : "", fmt::join(names, ", "));
}

class New final : public Verb {
  public:
    New()
        : Verb("new", "Write a commented scene file to start from",
               "Beside it lies grainreel.schema.json, by which editors with taplo (Even Better TOML, for "
               "one)\n"
               "complete and check it. An existing file is never overwritten.\n"
               "Exit status: 0 done, 1 the file could not be written, 2 a mistake in the options.") {}

    void add_options(CLI::App& parser) override {
        parser.add_option("NAME", name_, "Name of the file, with .toml or without [that of the scene]")
            ->option_text("[NAME]");
        parser
            .add_option("--from", from_,
                        "Scene to copy, or words of its name, as in brazil-nut; grainreel scenes lists them")
            ->option_text("SCENE [" + from_ + "]");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        const ShippedScene& scene = scene_called(from_);
        fs::path file = name_.empty() ? fs::path(scene.name) : name_;
        if (file.extension() != ".toml") file += ".toml";
        check_free(file);
        replace_file(file, fmt::format("#:schema ./{}\n", schema_name) + std::string(scene.text));
        const fs::path schema = file.parent_path() / schema_name;
        if (std::error_code ignored; !fs::exists(fs::symlink_status(schema, ignored)))
            replace_file(schema, scene_schema());
        reporter.info(fmt::format("wrote {}, a copy of {}; change it, then: {} check {}", file.string(),
                                  scene.name, program_call(), shell_word(file.string())));
        print_exact(file.string() + "\n");
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    static void check_free(const fs::path& file) {
        check_typed("NAME", file.string());
        std::error_code ignored;
        if (fs::exists(fs::symlink_status(file, ignored)))
            throw UserError("{}: is there already; choose another name", file.string());
        const fs::path folder = file.parent_path();
        if (!folder.empty() && !is_folder(folder))
            throw UserError("{}: there is no such folder; make it first", folder.string());
    }

    fs::path name_;
    std::string from_ = default_scene;
};

}  // namespace

std::unique_ptr<Verb> new_verb() {
    return std::make_unique<New>();
}

}  // namespace grainreel

// The verb `completion`: a script with which a shell completes our command line.
#include <fmt/format.h>

#include "engine/scene/shipped/shipped_scenes.hpp"
#include "render/app/command_line.hpp"
#include "render/app/manual/completion.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {
namespace {

class Completion final : public Verb {
  public:
    Completion()
        : Verb("completion", "Print a script with which bash, zsh or fish completes this command line",
               "Try it in this shell:  source <(grainreel completion bash)\n"
               "To keep it, save it as bash-completion/completions/grainreel in ~/.local/share (bash), as "
               "_grainreel\n"
               "in a folder of $fpath (zsh), or as ~/.config/fish/completions/grainreel.fish (fish). A "
               "package of\n"
               "grainreel has them already.\n"
               "Exit status: 0 done, 2 a mistake in the options.") {}

    void add_options(CLI::App& parser) override {
        parser.add_option("SHELL", shell_, "The shell")
            ->required()
            ->type_name("WHICH")
            ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    }

    int run(Reporter&) override {
        const auto verbs = all_verbs();
        CompletionWords known{command_table(*make_parser(verbs)), filmed_scene_keys(), {}};
        for (const ShippedScene& scene : shipped_scenes()) known.scenes.push_back(scene.name);
        print_result(shell_ == "bash"  ? bash_completion(known)
                     : shell_ == "zsh" ? zsh_completion(known)
                                       : fish_completion(known));
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    std::string shell_;
};

}  // namespace

std::unique_ptr<Verb> completion_verb() {
    return std::make_unique<Completion>();
}

}  // namespace grainreel

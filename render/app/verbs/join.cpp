// The verb `join` joins the parts of a film that render --part has drawn into one film.
#include <fmt/format.h>

#include "render/app/messages/reporter.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/film_in_parts.hpp"

namespace grainreel {
namespace {

class Join final : public Verb {
  public:
    Join()
        : Verb("join", "Put the parts of a film together",
               fmt::format("Nothing is encoded again: the film has the same bytes as a film drawn in one go "
                           "with --parts.\n"
                           "Parts that are missing, doubled, incomplete, damaged, or from another run or "
                           "with other\n"
                           "options are refused (docs/guide/clusters.md). The film's name goes to stdout.\n"
                           "{}",
                           exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser.add_option("PART", request_.parts, "Folders of all parts, in any order")
            ->required()
            ->type_name("DIR");
        add_typed(parser, "--out", request_.out, "The film's file, as in film.mp4", "FILE")
            ->required()
            ->check(not_empty());
        parser.add_flag("--force", request_.force, "Replace the file in --out, once the new one is complete");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        if (!join_parts(request_, reporter)) return signal_base + reporter.stop_signal();
        print_exact(request_.out.string() + "\n");
        return 0;
    }

  private:
    JoinRequest request_;
};

}  // namespace

std::unique_ptr<Verb> join_verb() {
    return std::make_unique<Join>();
}

}  // namespace grainreel

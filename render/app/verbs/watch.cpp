// The verb `watch` shows a run as a page in a browser while it is computed.
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/report.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/page/live/watch.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

class WatchVerb final : public Verb {
  public:
    WatchVerb()
        : Verb("watch", "Show a run while it goes, as a page for a browser",
               fmt::format("Visitors of the page can change nothing in RUN. Ctrl-C ends the page; the run "
                           "goes on.\n"
                           "{}",
                           exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser.add_option("RUN", run_, "Folder of a run, which may still go on or be finished")
            ->required()
            ->type_name("DIR");
        add_watch_port(parser, place_);
        add_watch_host(parser, place_);
        // Only `movie --watch` gives these two: a socket that listens, and a pipe that closes when the run
        // ends.
        parser.add_option("--socket", socket_)->group("");
        parser.add_option("--until", until_)->group("");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        check_typed("RUN", run_.string());
        folder_of_run(run_);
        const bool begins = socket_.has_value();  // the run's files are still to come
        if (!begins && !is_there(run_ / "run.json"))
            throw UserError("{}: holds no run (no run.json); give the folder of a run", run_.string());
        Listening listening = socket_ ? Listening(*socket_) : listen_at(place_);
        return watch_run({run_, place_.host, std::move(listening), until_.value_or(-1)}, planned_scene,
                         reporter);
    }

  private:
    fs::path run_;
    WatchPlace place_;
    std::optional<int> socket_, until_;
};

}  // namespace

std::unique_ptr<Verb> watch_verb() {
    return std::make_unique<WatchVerb>();
}

}  // namespace grainreel

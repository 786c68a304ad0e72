// A run that lies on disk: a folder of ours (finished, stopped, killed or still going on), files of another
// program, or a single state. It tells which moments the run has, and gives each of them: from a file where
// it was kept, else computed again from a checkpoint ("brought back"). Nothing here changes a file. One
// thread uses a StoredRun at a time.
//
// A part that is missing or damaged is no error here. lack_of() says what is wrong with it, in words that
// name the file; the caller adds what follows from that, or throws.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/wear_file.hpp"
#include "engine/measure/measures.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/run/stored/kept_list.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Where a moment of a run can be had.
enum class Origin { trajectory, film_moments, checkpoint, nowhere };

// What lies beside the grains.
enum class Part { contacts, measures, wear, outflow };

// Why a part cannot be used.
struct Lack {
    std::string what;      // "run/contacts.nc: was cut off"
    bool some = false;     // only the last moments lack it
    bool damaged = false;  // the file cannot be read, or is of another run
};

struct StoredMoment {
    State frame;
    Origin origin = Origin::trajectory;
    std::optional<std::vector<Link>> touches{};  // where they were asked for, and are known
};

struct StoredRunRequest {
    ReadingOptions reading{};  // for files of other programs
    // Reads the scene of a run's folder. None: it is read as the engine reads it.
    std::function<Scene(const std::filesystem::path& folder)> scene_of_run{};
    // Threads of the engine that brings moments back; 0: as many as its scene says. None: nothing is brought
    // back.
    std::optional<int> threads{};
    bool contacts = true;  // whether contacts.nc is read
};

class StoredRun final : public StateArchive {
  public:
    // ours: our engine computed it. elsewhere: a scene that was handed over. imported: a copy of another
    // program's files. foreign: those files themselves. state: a checkpoint, a table of grains, or a
    // trajectory without its folder.
    enum class Kind { ours, elsewhere, imported, foreign, state };

    // Throws UserError where nothing can be read, where there is no moment, and where trajectory.nc or
    // measures.csv is of another run than its scene.
    explicit StoredRun(const std::filesystem::path& path, const StoredRunRequest& request = {});
    // Frames that a program has at hand; nothing is brought back.
    explicit StoredRun(std::shared_ptr<const StateArchive> frames);
    ~StoredRun() override;
    StoredRun(const StoredRun&) = delete;
    StoredRun& operator=(const StoredRun&) = delete;

    Kind kind() const { return kind_; }
    // Its scene; without one, the scene that its world describes.
    const Scene& known_scene() const { return scene_; }
    const Clock& clock() const { return clock_; }
    // Sets after how many periods the bed repeats itself, if the caller knows better.
    void set_periods(int periods) { periods_ = periods; }
    double from() const { return moments().front().time; }  // s
    double to() const { return moments().back().time; }
    // The step of the last moment, or of the last checkpoint if that is later. A run that was broken off has
    // checkpoints after its last kept moment.
    std::int64_t last_step() const;
    std::string name_of(const char* file) const { return (path() / file).string(); }

    // The moments of the trajectory, or of other files, by index.
    const std::filesystem::path& path() const override { return frames_->path(); }
    const StoredWorld& world() const override { return frames_->world(); }
    StateSupply supply() const override;
    const std::vector<State>& moments() const override { return moments_ ? *moments_ : frames_->moments(); }
    State grains(std::size_t index) const override;
    std::optional<std::vector<Link>> touches(std::size_t index) const override;
    std::optional<std::vector<SavedContact>> contacts(std::size_t index) const override;
    bool has_contacts_of(std::size_t index) const override;
    std::optional<MeasuredRow> measured_near(std::size_t index) const override;
    std::shared_ptr<const FieldsReader> fields() const override;
    std::size_t place(std::size_t index) const override { return frames_->place(number(index)); }
    std::optional<WorldCell> cell(std::size_t index) const override { return frames_->cell(number(index)); }
    std::optional<std::int64_t> written_step(std::size_t index) const override {
        return frames_->written_step(number(index));
    }
    int periods() const override { return periods_.value_or(frames_->periods()); }
    State first() const override { return is_folder_ ? first_whole() : frames_->first(); }
    const Scene* scene() const override { return frames_->scene(); }
    std::vector<std::string> news() const override;
    std::vector<std::string> news_of_frames() const override { return frames_->news_of_frames(); }

    // The moments of the trajectory and of the film's pictures. Only a run's folder has the latter.
    const KeptList& kept() const;
    // The moment of the trajectory at that time (s), if there is one. Kept and wanted times both lie on
    // steps.
    std::optional<std::size_t> index_near(double time) const;

    // Where a step comes from. with_contacts: its contacts are wanted too. A kept moment whose contacts are
    // not known is brought back if possible.
    Origin origin_of(std::int64_t step, bool with_contacts) const;
    // The moment, from the first place that has it undamaged. Empty when the watcher stopped it. Throws
    // UserError where it cannot be had, and as brought_back() does.
    std::optional<StoredMoment> at(std::int64_t step, bool with_contacts, const ReplayWatcher& watcher);
    // The engine at that step, for forces; valid until the next call. Throws UserError where a replay gives
    // other grains than were kept (prove), and RunError when it fails or the watcher stops it.
    SimulatedBed& brought_back(std::int64_t step, const ReplayWatcher& watcher);
    // Replays to a kept moment on the way to the step, if there is one, and compares the grains. Throws
    // UserError when they differ: then the checkpoints are of another run. Only the first call compares.
    void prove(std::int64_t step, const ReplayWatcher& watcher);
    // Whether a checkpoint leads to that step; to all moments.
    bool brings_back(std::int64_t step) const;
    bool brings_all_back() const { return brings_back(moments().front().step); }
    // Its own checkpoints by rising step, and words about those that are passed over: they are of another
    // run, or damaged.
    const std::vector<KeptCheckpoint>& checkpoints() const;
    const std::vector<std::string>& checkpoint_news() const;

    // What is wrong with a part of a run's folder; none where it is whole.
    std::optional<Lack> lack_of(Part part) const;
    const std::shared_ptr<const MeasureTable>& measures() const { return measures_; }  // null for none
    // What the grains have done to the meshes until a time (s), and what has left; empty where that is
    // lacking.
    std::shared_ptr<const std::vector<MeshWear>> worn(double time) const;
    std::optional<FlowedOut> flowed_out(double time) const;

    // Reads all frames with their contacts, and leaves out damaged frames. Throws UserError where none is
    // left, and where contacts are damaged.
    void check_all();
    // Damage because of which less can be answered, in whole sentences.
    std::vector<std::string> faults() const;
    // The news and the faults, each line once.
    std::vector<std::string> all_news() const;

  private:
    void take(std::shared_ptr<const StateArchive> frames);
    void read_folder(const std::filesystem::path& folder, const StoredRunRequest& request);
    void restore(const std::filesystem::path& checkpoint);
    Replayer& replayer();
    // Number of a moment in frames_.
    std::size_t number(std::size_t index) const { return moments_ ? numbers_.at(index) : index; }
    void leave_out(const std::vector<std::size_t>& indices);
    std::string damage_line(const std::string& first, const std::vector<std::size_t>& places) const;

    // stored_parts.cpp
    void read_measures();
    void use_contacts();
    void open_contacts();
    void leave_out_unfinished_contacts();
    void check_contacts_of_run() const;
    std::optional<Lack> measures_lack() const;
    void read_wear() const;
    void read_outflow() const;

    std::shared_ptr<const StateArchive> frames_;
    bool is_folder_ = false;  // whether it is the folder of a run
    // The moments, and their numbers in frames_; set where some are left out.
    std::optional<std::vector<State>> moments_;
    std::vector<std::size_t> numbers_;
    Kind kind_ = Kind::foreign;
    Scene scene_;
    Clock clock_;
    std::optional<int> periods_, threads_;
    std::shared_ptr<const MeasureTable> measures_;
    std::optional<ContactsReader> contacts_;
    std::optional<Lack> contacts_lack_;
    std::vector<std::string> faults_, news_;
    std::optional<State> restored_;  // of a checkpoint
    std::optional<MeasuredRow> restored_measures_;
    std::optional<Replayer> replayer_;
    bool proven_ = false;  // whether prove() has compared a replay with a kept moment
    struct Checkpoints {
        std::vector<KeptCheckpoint> own;
        std::vector<std::string> news;
    };
    // Read when they are first asked for.
    mutable std::optional<Checkpoints> checkpoints_;
    mutable std::unique_ptr<KeptList> kept_;
    mutable std::optional<WearReader> wear_;
    mutable std::optional<OutflowSums> outflow_;
    mutable std::optional<Lack> wear_lack_, outflow_lack_;
    mutable bool wear_read_ = false, outflow_read_ = false;
    // Whether the contacts of a frame are whole, as far as they were read; by its place in the trajectory.
    mutable std::map<std::size_t, bool> whole_contacts_;
};

// The touches of an engine's grains.
std::vector<Link> touches_of(const SimulatedBed& run);

}  // namespace grainreel

// The library's functions for frames on disk: reads and writes files, and adds the caller's own readers.
#include "engine/library/internal.hpp"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel::v1 {
namespace {

ReadingOptions reading_of(const ReadOptions& options) {
    ReadingOptions reading;
    reading.columns = options.columns;
    reading.radius = options.radius;
    reading.time_step = options.time_step;
    reading.units = options.units;
    reading.density = options.density;
    reading.one = !options.series;
    return reading;
}

// The frames of a caller's reader, checked, as an archive of the program.
class OwnArchive final : public StateArchive {
  public:
    OwnArchive(std::filesystem::path path, std::unique_ptr<FrameSource> source)
        : path_(std::move(path)), source_(std::move(source)) {
        if (!source_) throw Error(fmt::format("{}: its reader opened nothing", path_.string()));
        world_ = inside(source_->world());
        for (const double time : source_->times()) add_moment(time);
        world_.time_known = !moments_.empty() && !std::isnan(moments_.front().time);
    }

    const std::filesystem::path& path() const override { return path_; }
    const grainreel::StoredWorld& world() const override { return world_; }
    StateSupply supply() const override {
        StateSupply supply;
        supply.velocities = supply.spins = source_->has_velocities();
        supply.masses = source_->has_masses();
        return supply;
    }
    const std::vector<grainreel::State>& moments() const override { return moments_; }
    grainreel::State grains(std::size_t index) const override {
        const std::string who = fmt::format("{}: frame {}", path_.string(), index);
        grainreel::State frame = inside(source_->frame(index), world_.species.size(), who);
        frame.step = moments_[index].step;
        frame.time = frame.cycles = moments_[index].time;
        frame.phase = 0;
        if (frame.size() > 0 && frame.mass.empty() == source_->has_masses())
            throw Error(fmt::format("{}: has {}masses, unlike what its reader says (has_masses())", who,
                                    frame.mass.empty() ? "no " : ""));
        return frame;
    }

  private:
    void add_moment(double time) {
        if (!moments_.empty() && !(time >= moments_.back().time) && !std::isnan(time))
            throw Error(fmt::format("{}: the times of its frames do not rise", path_.string()));
        grainreel::State& moment = moments_.emplace_back();
        moment.step = std::ssize(moments_) - 1;
        moment.time = moment.cycles = time;
    }

    std::filesystem::path path_;
    std::unique_ptr<FrameSource> source_;
    grainreel::StoredWorld world_;
    std::vector<grainreel::State> moments_;
};

class Adapted final : public OwnReader {
  public:
    explicit Adapted(std::shared_ptr<const FrameReader> reader) : reader_(std::move(reader)) {}
    std::string name() const override { return reader_->name(); }
    std::string about() const override { return reader_->about(); }
    bool takes(const grainreel::FileStart& head) const override {
        return reader_->takes({head.path, head.folder, head.size, head.bytes});
    }
    std::unique_ptr<StateArchive> open(const std::filesystem::path& path, const OpenRequest&) const override {
        return std::make_unique<OwnArchive>(path, reader_->open(path));
    }

  private:
    std::shared_ptr<const FrameReader> reader_;
};

}  // namespace

FrameFile::FrameFile(const std::filesystem::path& file, const ReadOptions& options)
    : impl_(std::make_unique<Impl>()) {
    StoredRunRequest request;
    request.reading = reading_of(options);
    impl_->archive = told([&] { return std::make_unique<StoredRun>(file, request); });
}
FrameFile::~FrameFile() = default;
FrameFile::FrameFile(FrameFile&&) noexcept = default;
FrameFile& FrameFile::operator=(FrameFile&&) noexcept = default;

std::size_t FrameFile::size() const {
    return impl_->archive->moments().size();
}

double FrameFile::time(std::size_t index) const {
    if (index >= size())
        throw Error(fmt::format("{}: has {} frames, and no frame {}", impl_->archive->path().string(), size(),
                                index));
    return impl_->archive->world().time_known ? impl_->archive->moments()[index].time : NAN;
}

std::size_t FrameFile::nearest(double time) const {
    if (!impl_->archive->world().time_known)
        throw Error(
            fmt::format("{}: says no times; choose a frame by its number", impl_->archive->path().string()));
    return impl_->archive->nearest(time);
}

Frame FrameFile::frame(std::size_t index) const {
    const double at = time(index);
    Frame frame = outside(told([&] { return impl_->archive->grains(index); }));
    frame.time = at;
    return frame;
}

World FrameFile::world() const {
    return outside(impl_->archive->world());
}

bool FrameFile::has_velocities() const {
    return impl_->archive->supply().velocities;
}

std::vector<std::string> FrameFile::news() const {
    return impl_->archive->all_news();
}

void FrameFile::write(const std::filesystem::path& file, const std::string& format) const {
    told([&] { export_frames(*impl_->archive, format, file, {}, false, [](double) { return true; }); });
}

void add_reader(std::shared_ptr<const FrameReader> reader) {
    if (!reader) throw Error("a reader of one's own is null");
    add_own_reader(std::make_shared<Adapted>(std::move(reader)));
}

std::vector<std::string> written_formats() {
    std::vector<std::string> names;
    for (const WriteFormat& format : frame_formats()) names.emplace_back(format.name);
    return names;
}

struct FrameWriter::Impl {
    Impl(std::filesystem::path path, const World& given) : file(std::move(path)), world(inside(given)) {}
    ~Impl() { leave_nothing(); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::string name() const { return file.string(); }
    void leave_nothing();
    void make(const std::string& format);
    void begin(const grainreel::State& first);
    void put(const grainreel::State& frame);
    void check_supply(const grainreel::State& frame) const;
    void take_step(grainreel::State& frame);
    void check_time(const grainreel::State& frame) const;

    std::filesystem::path file;
    grainreel::StoredWorld world;
    std::unique_ptr<grainreel::StateWriter> writer;
    bool made = false, begun = false, closed = false;
    std::int64_t frames = 0;
    std::vector<grainreel::State> waiting;
    StateSupply supply;
    double time = 0;        // s, time of the last frame
    std::int64_t step = 0;  // step of the last frame
    bool numbered = true;   // all frames came with the step 0
};

// Removes a file without a frame, which would only be in the way of the next attempt.
void FrameWriter::Impl::leave_nothing() {
    writer.reset();
    std::error_code ignored;
    if (made && frames == 0) std::filesystem::remove_all(file, ignored);
    made = false;
}

void FrameWriter::Impl::make(const std::string& format) {
    std::error_code error;
    check_folder_around(file, name());
    if (std::filesystem::exists(std::filesystem::symlink_status(file, error)))
        throw UserError("{}: exists already; choose another name", name());
    made = true;
    writer = frame_writer(format, file);
}

// The first frame with grains tells what all frames have. Those before it wait.
void FrameWriter::Impl::begin(const grainreel::State& first) {
    supply.orientations = !first.orientation.empty();
    supply.masses = !first.mass.empty();
    if (first.size() > 0) world.first_id = first.id.front() == 0 ? 0 : 1;
    writer->begin(world, supply);
    begun = true;
    for (const grainreel::State& frame : waiting) writer->frame(frame, {});
    waiting.clear();
}

void FrameWriter::Impl::put(const grainreel::State& frame) {
    if (frames == 0) world.time_known = !std::isnan(frame.time);
    if (!begun && frame.size() == 0) {
        waiting.push_back(frame);
        return;
    }
    if (!begun) begin(frame);
    writer->frame(frame, {});
}

void FrameWriter::Impl::check_supply(const grainreel::State& frame) const {
    if (!begun || frame.size() == 0) return;
    const auto check = [&](bool before, bool now, const char* what) {
        if (before != now)
            throw Error(fmt::format(
                "{}: frame {}: has {}{}, unlike the frames before it; give them in all frames, or in none",
                name(), frames, now ? "" : "no ", what));
    };
    check(supply.orientations, !frame.orientation.empty(), "orientations");
    check(supply.masses, !frame.mass.empty(), "masses");
}

void FrameWriter::Impl::check_time(const grainreel::State& frame) const {
    if (frames == 0) return;
    if (std::isnan(frame.time) != !world.time_known)
        throw Error(fmt::format(
            "{}: frame {}: has {}, and the frames before it have {}; give all of them a "
            "time, or NaN if none is known",
            name(), frames, world.time_known ? "no time" : "a time", world.time_known ? "one" : "none"));
    if (world.time_known && !(frame.time > time))
        throw Error(
            fmt::format("{}: frame {}: its time is {} s, and that of the frame before it {} s; give "
                        "frames by rising time, or NaN in all of them if no times are known",
                        name(), frames, frame.time, time));
}

// Readers of many formats take two frames with one step for one frame, written twice.
void FrameWriter::Impl::take_step(grainreel::State& frame) {
    if (frames == 0) return;
    if (numbered && frame.step == 0) {
        frame.step = step + 1;
    } else if (frame.step <= step) {
        throw Error(
            fmt::format("{}: frame {}: its step is {}, and that of the frame before it {}; give "
                        "rising steps, or 0 in all frames",
                        name(), frames, frame.step, step));
    }
}

FrameWriter::FrameWriter(const std::filesystem::path& file, const std::string& format, const World& world)
    : impl_(std::make_unique<Impl>(file, world)) {
    told([&] { impl_->make(format); });
}
FrameWriter::~FrameWriter() = default;
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;

void FrameWriter::write(const Frame& frame) {
    Impl& to = *impl_;
    if (to.closed) throw Error(fmt::format("{}: is closed", to.name()));
    const std::string who = fmt::format("{}: frame {}", to.name(), to.frames);
    grainreel::State inner = inside(frame, to.world.species.size(), who);
    take_poses(inner, frame.bodies.size(), to.world.bodies.size(), who);
    if (std::isnan(inner.time) && std::isnan(inner.cycles)) inner.cycles = 0;
    check_moment(inner, who);
    to.check_time(inner);
    to.check_supply(inner);
    to.take_step(inner);
    told([&] { to.put(inner); });
    to.numbered = to.numbered && frame.step == 0;
    to.time = inner.time;
    to.step = inner.step;
    ++to.frames;
}

void FrameWriter::close() {
    Impl& to = *impl_;
    if (to.closed) return;
    to.closed = true;
    if (to.frames == 0) {
        to.leave_nothing();
        throw Error(fmt::format("{}: is closed without a frame; no file is left", to.name()));
    }
    told([&] {
        if (!to.begun) to.begin(to.waiting.front());
        to.writer->end();
    });
    to.writer.reset();
}

}  // namespace grainreel::v1

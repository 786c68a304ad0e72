// The library's functions for frames on disk: reads and writes files, and adds the caller's own readers.
#include "engine/library/internal.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/files/frames/frame_writer.hpp"
#include "engine/files/frames/open_frames.hpp"

namespace grainreel::v1 {
namespace {

ReadingOptions reading_of(const ReadOptions& options) {
    ReadingOptions reading;
    reading.columns = options.columns;
    reading.radius = options.radius;
    reading.time_step = options.time_step;
    reading.units = options.units;
    reading.density = options.density;
    return reading;
}

// The frames of a caller's reader, checked, as an archive of the program.
class OwnArchive final : public FrameArchive {
  public:
    OwnArchive(std::filesystem::path path, std::unique_ptr<FrameSource> source)
        : path_(std::move(path)), source_(std::move(source)) {
        if (!source_) throw Error(fmt::format("{}: its reader opened nothing", path_.string()));
        world_ = inside(source_->world());
        for (const double time : source_->times()) add_moment(time);
        world_.time_known = !moments_.empty() && !std::isnan(moments_.front().time);
    }

    const std::filesystem::path& path() const override { return path_; }
    const grainreel::World& world() const override { return world_; }
    FrameSupply supply() const override {
        FrameSupply supply;
        supply.velocities = supply.spins = source_->has_velocities();
        return supply;
    }
    const std::vector<grainreel::Frame>& moments() const override { return moments_; }
    grainreel::Frame grains(std::size_t index) const override {
        const std::string who = fmt::format("{}: frame {}", path_.string(), index);
        grainreel::Frame frame = inside(source_->frame(index), world_.species.size(), who);
        frame.step = moments_[index].step;
        frame.time = frame.cycles = moments_[index].time;
        frame.phase = 0;
        return frame;
    }

  private:
    void add_moment(double time) {
        if (!moments_.empty() && !(time >= moments_.back().time) && !std::isnan(time))
            throw Error(fmt::format("{}: the times of its frames do not rise", path_.string()));
        grainreel::Frame& moment = moments_.emplace_back();
        moment.step = std::ssize(moments_) - 1;
        moment.time = moment.cycles = time;
    }

    std::filesystem::path path_;
    std::unique_ptr<FrameSource> source_;
    grainreel::World world_;
    std::vector<grainreel::Frame> moments_;
};

class Adapted final : public OwnReader {
  public:
    explicit Adapted(std::shared_ptr<const FrameReader> reader) : reader_(std::move(reader)) {}
    std::string name() const override { return reader_->name(); }
    std::string about() const override { return reader_->about(); }
    bool takes(const grainreel::FileHead& head) const override {
        return reader_->takes({head.path, head.folder, head.size, head.bytes});
    }
    std::unique_ptr<FrameArchive> open(const std::filesystem::path& path,
                                       const FrameRequest&) const override {
        return std::make_unique<OwnArchive>(path, reader_->open(path));
    }

  private:
    std::shared_ptr<const FrameReader> reader_;
};

}  // namespace

FrameFile::FrameFile(const std::filesystem::path& file, const ReadOptions& options)
    : impl_(std::make_unique<Impl>()) {
    FrameRequest request;
    request.reading = reading_of(options);
    impl_->archive = told([&] { return open_frames(file, request); });
}
FrameFile::~FrameFile() = default;
FrameFile::FrameFile(FrameFile&&) noexcept = default;
FrameFile& FrameFile::operator=(FrameFile&&) noexcept = default;

std::size_t FrameFile::size() const {
    return impl_->archive->moments().size();
}

double FrameFile::time(std::size_t index) const {
    if (index < size()) return impl_->archive->moments()[index].time;
    throw Error(
        fmt::format("{}: has {} frames, and no frame {}", impl_->archive->path().string(), size(), index));
}

std::size_t FrameFile::nearest(double time) const {
    return impl_->archive->nearest(time);
}

Frame FrameFile::frame(std::size_t index) const {
    time(index);
    return outside(told([&] { return impl_->archive->grains(index); }));
}

World FrameFile::world() const {
    return outside(impl_->archive->world());
}

bool FrameFile::has_velocities() const {
    return impl_->archive->supply().velocities;
}

std::vector<std::string> FrameFile::news() const {
    return impl_->archive->news();
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
    for (const FrameFormat& format : frame_formats()) names.emplace_back(format.name);
    return names;
}

struct FrameWriter::Impl {
    grainreel::World world;
    std::unique_ptr<grainreel::FrameWriter> writer;
    std::string file;
    double last = -INFINITY;
};

FrameWriter::FrameWriter(const std::filesystem::path& file, const std::string& format, const World& world)
    : impl_(std::make_unique<Impl>()) {
    impl_->world = inside(world);
    impl_->file = file.string();
    told([&] {
        if (std::filesystem::exists(file))
            throw UserError(fmt::format("{}: exists already; choose another name", file.string()));
        impl_->writer = frame_writer(format, file);
        impl_->writer->begin(impl_->world, {});
    });
}
FrameWriter::~FrameWriter() = default;
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;

void FrameWriter::write(const Frame& frame) {
    if (!impl_->writer) throw Error(fmt::format("{}: is closed", impl_->file));
    const grainreel::Frame inner =
        inside(frame, impl_->world.species.size(), fmt::format("a frame for {}", impl_->file));
    if (!(inner.time >= impl_->last))
        throw Error(
            fmt::format("{}: a frame of {} s comes after one of {} s", impl_->file, inner.time, impl_->last));
    impl_->last = inner.time;
    told([&] { impl_->writer->frame(inner); });
}

void FrameWriter::close() {
    if (!impl_->writer) return;
    told([&] { impl_->writer->end(); });
    impl_->writer.reset();
}

}  // namespace grainreel::v1

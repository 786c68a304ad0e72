#include "render/page/live/live_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/measure/columns.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_file.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/methods.hpp"
#include "render/page/facts/page_facts.hpp"
#include "render/page/page_film.hpp"
#include "render/page/page_measures.hpp"
#include "render/page/page_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;
using Steady = std::chrono::steady_clock;

constexpr std::size_t most_rows = 400;  // rows of measures that are shown, evenly spread
constexpr double picture_share = 0.05;  // largest share of the time that reading pictures may take
constexpr std::chrono::duration<double> looked_back{60};  // time over which the speed is taken
constexpr std::chrono::duration<double> settled_rate{
    3};  // time that must have been seen before a speed is known

LiveSnapshot::Bytes shared(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

fs::file_time_type changed(const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    return error ? fs::file_time_type::min() : time;
}

std::uintmax_t size_of(const fs::path& file) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    return error ? 0 : size;
}

// The moments that are read: the first, the last but one and the last. Colours by start height need the first
// one, colours by rise the last two.
std::vector<std::size_t> shown_of(std::size_t moments) {
    std::vector<std::size_t> shown = {0};
    for (const std::size_t from_end : {2u, 1u})
        if (moments > from_end && moments - from_end > shown.back()) shown.push_back(moments - from_end);
    return shown;
}

std::string with_length(const std::string& json, const std::vector<std::uint8_t>& packed) {
    const auto length = static_cast<std::uint32_t>(json.size());
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &length, 4);
    return bytes.append(json).append(packed.begin(), packed.end());
}

}  // namespace

LiveRun::LiveRun(fs::path folder, Planner planner)
    : folder_(std::move(folder)), planner_(std::move(planner)) {}

LiveSnapshot LiveRun::now() const {
    const std::scoped_lock lock(mutex_);
    return now_;
}

std::string LiveRun::title() const {
    if (!scene_) return folder_.filename().string();
    return scene_->title.empty() ? scene_->name : scene_->title;
}

void LiveRun::refresh() {
    gone_ = !is_folder(folder_);
    if (!gone_) {
        status_ = read_run_json(folder_ / "run.json").status;
        over_ = !FolderLock::holder(folder_).has_value();
        if (over_ && (status_.empty() || status_ == "running")) status_ = "broken off";
        read_scene_again();
        if (scene_) {
            read_measures_again();
            read_bed_again();
            read_picture_again();
        }
        make_page();
    }
    make_state();
}

void LiveRun::read_scene_again() {
    const fs::path file = folder_ / "scene.toml";
    const fs::file_time_type time = changed(file);
    if (!is_plain(file) || time == scene_time_ || time == fs::file_time_type::min()) return;
    try {
        scene_ = read_filmed_scene(file, {}, measurable_in);
        scene_->name = folder_.filename().string();
        scene_time_ = time;
        meshes_.reset();
        page_status_.clear();
    } catch (const UserError&) {
        // The file may be half written; the next look will tell.
    }
}

void LiveRun::read_measures_again() {
    const std::uintmax_t size = size_of(folder_ / "measures.csv");
    if (size == measures_size_) return;
    const auto table = read_measures(folder_ / "measures.csv");
    if (!table || table->rows() == 0) return;
    PageMeasures measures = page_measures(*scene_, *table);
    if (measures.time >= measures.columns.size()) return;
    measures_size_ = size;
    rows_ = table->rows();
    begin_ = table->values(measures.time, 0, 1).front();
    time_ = table->values(measures.time, rows_ - 1, rows_).front();
    if (!seen_.empty() && time_ < seen_.back().simulated)
        seen_.clear();  // time went back: another run has the folder now
    seen_.push_back({time_, Steady::now()});
    while (seen_.size() > 2 && seen_.back().at - seen_[1].at > looked_back) seen_.pop_front();
    measures.rows = spread_rows(rows_, most_rows);
    auto json = shared(all_measures_json(*table, measures));
    const std::scoped_lock lock(mutex_);
    now_.measures = std::move(json);
}

void LiveRun::read_bed_again() {
    const fs::file_time_type time = changed(folder_ / "trajectory.nc");
    if (time == trajectory_time_ || time == fs::file_time_type::min()) return;
    try {
        StoredRunRequest request;
        request.contacts = false;
        const FilmedRun filmed = open_filmed(folder_, {}, request);
        const StoredRun& run = *filmed.run;
        const std::vector<State>& moments = run.moments();
        trajectory_time_ = time;
        if (moments.back().step == bed_step_) return;
        std::optional<FilmColours> film;
        if (film_has_scale(filmed.scene)) film.emplace(filmed.scene, run, run.clock(), run.from());
        PageContacts beside;
        beside.film = film ? &*film : nullptr;
        const PageBed bed = page_bed_of(run, shown_of(moments.size()), kNoPageProgress, beside);
        make_meshes(filmed.scene);
        bed_step_ = moments.back().step;
        bed_time_ = moments.back().time;
        auto bytes = shared(with_length(bed_facts_json(filmed.scene, bed, *meshes_), bed.packed));
        const std::scoped_lock lock(mutex_);
        now_.bed = std::move(bytes);
    } catch (const UserError&) {
        // There is no complete moment yet.
    } catch (const RunError&) {
    }
}

// Makes the meshes once, since shapes never change.
void LiveRun::make_meshes(const FilmedScene& scene) {
    if (meshes_) return;
    constexpr std::size_t most_bytes = 2'000'000;
    meshes_ = page_meshes(scene, most_bytes);
    auto bytes = shared(std::string(meshes_->packed.begin(), meshes_->packed.end()));
    const std::scoped_lock lock(mutex_);
    now_.meshes = std::move(bytes);
}

std::optional<fs::path> LiveRun::film() const {
    for (const char* name : {"movie.mp4", "movie.webm", "movie.mkv"})
        if (size_of(folder_ / name) > 0) return folder_ / name;
    return std::nullopt;
}

void LiveRun::read_picture_again() {
    const std::optional<fs::path> file = film();
    if (!file || size_of(*file) == film_size_) return;
    const auto begin = Steady::now();
    if (begin - picture_at_ < picture_took_ / picture_share) return;
    film_size_ = size_of(*file);
    const std::vector<std::uint8_t> jpeg = last_picture(*file);
    picture_at_ = Steady::now();
    picture_took_ = picture_at_ - begin;
    if (jpeg.empty()) return;
    ++pictures_;
    auto bytes = shared(std::string(jpeg.begin(), jpeg.end()));
    const std::scoped_lock lock(mutex_);
    now_.picture = std::move(bytes);
}

void LiveRun::make_page() {
    const std::string now = scene_ ? status_ : "waiting";
    if (now == page_status_) return;
    auto page = shared(scene_ ? live_page(*scene_, folder_, planner_(*scene_)) : waiting_page(title()));
    page_status_ = now;
    const std::scoped_lock lock(mutex_);
    now_.page = std::move(page);
}

// Remaining wall time in s, from the speed of the last minute; negative while that is not known.
double LiveRun::remaining(double time, double end) const {
    if (seen_.size() < 2 || over_) return -1;
    const std::chrono::duration<double> passed = seen_.back().at - seen_.front().at;
    const double gained = seen_.back().simulated - seen_.front().simulated;
    return passed > settled_rate && gained > 0 ? passed.count() / gained * (end - time) : -1;
}

// live.js reads the members of the state by these names.
void LiveRun::make_state() {
    const double end = scene_ ? scene_->run.duration : 0;
    const bool begun = rows_ > 0;
    const double share = begun && end > begin_ ? std::clamp((time_ - begin_) / (end - begin_), 0.0, 1.0) : 0;
    const std::string stage = gone_                  ? "gone"
                              : status_ == "running" ? (begun ? "running" : "packing")
                                                     : status_;
    nlohmann::json state = {{"stage", stage},   {"over", over_ || gone_ || last_},
                            {"last", last_},    {"begin", begin_},
                            {"time", time_},    {"end", end},
                            {"done", share},    {"picture", pictures_},
                            {"bed", bed_step_}, {"bed_time", bed_time_},
                            {"rows", rows_},    {"report", !gone_ && is_there(folder_ / kPageName)}};
    const double left = begun ? remaining(time_, end) : -1;
    state["remaining"] = left >= 0 ? nlohmann::json(left) : nlohmann::json();
    auto text = shared(state.dump());
    const std::scoped_lock lock(mutex_);
    now_.state = std::move(text);
}

std::string live_page(const FilmedScene& scene, const std::filesystem::path& folder,
                      const std::optional<PlannedScene>& planned) {
    const ReadRunJson record = record_of_page(folder);
    const PageFiles& files = page_files();
    const PageWords say(scene.film.wording);
    const std::string about = html_text(say("One picture of the run: {1}", {lead_text(scene, say)}));
    const std::string picture =
        fmt::format("<img id=\"live-picture\" class=\"poster\" alt=\"{}\" hidden>\n", about);
    const std::string bed = filled(
        say.in(files.bed),
        {{"about",
          html_text(say("The newest moment that the run has written. Places are rounded to 16 bits over "
                        "the box that the grains reach."))},
         {"n", ""}});
    const std::string body =
        filled(say.in(files.body), {{"film", picture},
                                    {"bed", bed},
                                    {"fields", ""},
                                    {"charts", filled(say.in(files.charts), {{"about", ""}})}});
    return filled(say.in(files.page),
                  {{"title", html_text(scene.title.empty() ? scene.name : scene.title)},
                   {"lang", say.code()},
                   {"body_class", ""},
                   {"style", std::string(files.style)},
                   {"lead", lead_html(scene, say)},
                   {"live", say.in(files.live)},
                   {"body", body},
                   {"words", chapters_html(scene, record, planned, folder, kPageName, say)},
                   {"facts", json_in_html(say.with_words(live_facts_json(scene)))},
                   {"script", files.script(!scene.meshes.empty())},
                   {"blobs", ""}});
}

std::string waiting_page(const std::string& title) {
    const std::string text = html_text(title);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"refresh\" "
        "content=\"1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>{0}"
        "</title>\n</head>\n<body>\n<h1>{0}</h1>\n<p>The run begins.</p>\n</body>\n</html>\n",
        text);
}

namespace {

// The packets from the last key frame on. All earlier packets are read too, which takes almost no time, since
// they are not decoded.
std::vector<PacketPtr> last_packets(AVFormatContext& film, int stream) {
    std::vector<PacketPtr> packets;
    while (true) {
        PacketPtr packet(av_packet_alloc());
        // A packet that is not complete yet ends the film.
        if (!packet || av_read_frame(&film, packet.get()) < 0) return packets;
        if (packet->stream_index != stream) continue;
        if ((packet->flags & AV_PKT_FLAG_KEY) != 0) packets.clear();
        packets.push_back(std::move(packet));
    }
}

CodecPtr decoder_of(const AVStream& stream) {
    const AVCodec* decoder = avcodec_find_decoder(stream.codecpar->codec_id);
    CodecPtr codec(decoder != nullptr ? avcodec_alloc_context3(decoder) : nullptr);
    if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
    codec->thread_count = 1;
    return avcodec_open2(codec.get(), decoder, nullptr) < 0 ? nullptr : std::move(codec);
}

AvFramePtr last_frame(AVCodecContext& codec, const std::vector<PacketPtr>& packets) {
    AvFramePtr last, next(av_frame_alloc());
    const auto take = [&] {
        while (avcodec_receive_frame(&codec, next.get()) >= 0) {
            last = std::move(next);
            next.reset(av_frame_alloc());
        }
    };
    for (const PacketPtr& packet : packets) {
        avcodec_send_packet(&codec, packet.get());
        take();
    }
    avcodec_send_packet(&codec, nullptr);
    take();
    return last;
}

}  // namespace

std::vector<std::uint8_t> last_picture(const std::filesystem::path& film) {
    quiet_ffmpeg();
    InputPtr file;
    if (open_film(film, file) < 0) return {};
    AVFormatContext* const context = file.get();
    if (avformat_find_stream_info(context, nullptr) < 0) return {};
    const int stream = av_find_best_stream(context, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream < 0) return {};
    const CodecPtr codec = decoder_of(*context->streams[stream]);
    if (!codec) return {};
    const AvFramePtr frame = last_frame(*codec, last_packets(*context, stream));
    if (!frame) return {};
    try {
        return small_jpeg(*codec, *frame);
    } catch (const RunError&) {
        return {};
    }
}

}  // namespace grainreel

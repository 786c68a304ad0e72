#include "render/film/codec/ffmpeg.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

struct LibraryName {
    const char* name;
    int major;  // version of the headers; libraries of another major version have other structs
};

LibraryName library_name(FfmpegLibrary library) {
    switch (library) {
        case FfmpegLibrary::avutil:
            return {"avutil", LIBAVUTIL_VERSION_MAJOR};
        case FfmpegLibrary::avcodec:
            return {"avcodec", LIBAVCODEC_VERSION_MAJOR};
        case FfmpegLibrary::avformat:
            return {"avformat", LIBAVFORMAT_VERSION_MAJOR};
        case FfmpegLibrary::swscale:
            return {"swscale", LIBSWSCALE_VERSION_MAJOR};
        case FfmpegLibrary::avfilter:
            break;
    }
    return {"avfilter", LIBAVFILTER_VERSION_MAJOR};
}

// A library that is open already is only looked up. None is ever closed: codecs have threads of their own.
void* open_library(FfmpegLibrary library) {
    const auto [name, major] = library_name(library);
    if (void* const opened = dlopen(fmt::format("lib{}.so.{}", name, major).c_str(), RTLD_NOW)) return opened;
    throw RunError("film: FFmpeg's lib{0} cannot be opened ({2}); on Debian: apt-get install lib{0}{1}", name,
                   major, dlerror());
}

}  // namespace

void* ffmpeg_function(FfmpegLibrary library, const char* name) {
    if (void* const found = dlsym(open_library(library), name)) return found;
    throw RunError("film: FFmpeg is not as it should be ({}); install it again", dlerror());
}

namespace {

struct ErrorLog {
    std::mutex mutex;
    std::string last;
};

// The log is never destroyed: codecs write to it from their own threads until the process ends.
ErrorLog& error_log() {
    static ErrorLog& log = *new ErrorLog;
    return log;
}

void collect(void*, int level, const char* format, std::va_list arguments) {
    if (level > AV_LOG_ERROR) return;
    std::array<char, 512> line{};
    std::vsnprintf(line.data(), line.size(), format, arguments);
    std::string text = line.data();
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (text.empty()) return;
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    log.last = std::move(text);
}

// How many pictures an encoder has had. libavcodec 60.2 renamed the member.
std::int64_t pictures_given_to(const AVCodecContext& codec) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 2, 100)
    return codec.frame_num;
#else
    return codec.frame_number;
#endif
}

// Gives an encoder one black picture and throws the result away.
void encode_nothing(AVCodecContext& codec) {
    const AvFramePtr frame(av_frame_alloc());
    if (!frame) return;
    frame->format = codec.pix_fmt;
    frame->width = codec.width;
    frame->height = codec.height;
    frame->pts = 0;
    if (av_frame_get_buffer(frame.get(), 0) < 0) return;
    for (int plane = 0; frame->buf[plane]; ++plane)
        std::memset(frame->buf[plane]->data, 0, static_cast<std::size_t>(frame->buf[plane]->size));
    const PacketPtr packet(av_packet_alloc());
    avcodec_send_frame(&codec, frame.get());
    avcodec_send_frame(&codec, nullptr);
    while (packet && avcodec_receive_packet(&codec, packet.get()) >= 0) av_packet_unref(packet.get());
}

}  // namespace

void free_codec(AVCodecContext* codec) {
    // When SVT-AV1 1.4 is closed before it has had a picture, it waits for one for ever.
    const bool waits = avcodec_is_open(codec) && av_codec_is_encoder(codec->codec) &&
                       codec->codec_id == AV_CODEC_ID_AV1 && pictures_given_to(*codec) == 0;
    if (waits) encode_nothing(*codec);
    av_freep(&codec->stats_in);  // the figures of the first pass, which we have allocated
    avcodec_free_context(&codec);
}

void quiet_ffmpeg() {
    [[maybe_unused]] static const bool quiet = [] {
        for (const FfmpegLibrary library :
             {FfmpegLibrary::avutil, FfmpegLibrary::avcodec, FfmpegLibrary::avformat, FfmpegLibrary::swscale})
            open_library(library);
        av_log_set_callback(collect);
        ::setenv("SVT_LOG", "1", 0);  // SVT-AV1 prints past FFmpeg's log; with 1 it prints errors only
        return true;
    }();
}

std::vector<std::pair<std::string, std::string>> ffmpeg_versions() {
    const auto text = [](unsigned version) {
        return fmt::format("{}.{}.{}", AV_VERSION_MAJOR(version), AV_VERSION_MINOR(version),
                           AV_VERSION_MICRO(version));
    };
    return {{"FFmpeg", av_version_info()},
            {"libavformat", text(avformat_version())},
            {"libavcodec", text(avcodec_version())},
            {"libswscale", text(swscale_version())}};
}

std::string ffmpeg_error(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(code, reason.data(), reason.size());
    ErrorLog& log = error_log();
    const std::scoped_lock lock(log.mutex);
    const std::string detail = std::exchange(log.last, {});
    return detail.empty() ? reason.data() : std::string(reason.data()) + " (" + detail + ")";
}

namespace {

void check(int code) {
    if (code < 0) throw RunError("film: a filter of FFmpeg failed: {}", ffmpeg_error(code));
}

std::string source(const char* name, int width, int height, int pixels) {
    return fmt::format("buffer@{}=video_size={}x{}:pix_fmt={}:time_base=1/1", name, width, height, pixels);
}

}  // namespace

void FilterGraph::Free::operator()(AVFilterGraph* graph) const {
    avfilter_graph_free(&graph);
}

FilterGraph::FilterGraph(const AVCodecContext& codec, const std::string& filter, const AVFrame* second)
    : graph_(avfilter_graph_alloc()) {
    check(graph_ ? 0 : AVERROR(ENOMEM));
    graph_->nb_threads = 1;
    std::string text = source("first", codec.width, codec.height, codec.pix_fmt);
    if (second) {
        text += "[first];" + source("second", second->width, second->height, second->format) + "[second];";
        text += "[first][second]" + filter;
    } else {
        text += "," + filter;
    }
    AVFilterInOut *inputs = nullptr, *outputs = nullptr;
    const int code =
        avfilter_graph_parse2(graph_.get(), (text + ",buffersink@out").c_str(), &inputs, &outputs);
    avfilter_inout_free(&inputs);
    avfilter_inout_free(&outputs);
    check(code);
    check(avfilter_graph_config(graph_.get(), nullptr));
    source_ = avfilter_graph_get_filter(graph_.get(), "buffer@first");
    sink_ = avfilter_graph_get_filter(graph_.get(), "buffersink@out");
    if (!second) return;
    AVFilterContext* still = avfilter_graph_get_filter(graph_.get(), "buffer@second");
    const AvFramePtr copy(av_frame_clone(second));
    check(copy ? 0 : AVERROR(ENOMEM));
    copy->pts = 0;
    check(av_buffersrc_add_frame_flags(still, copy.get(), 0));
    check(av_buffersrc_add_frame_flags(still, nullptr, 0));
}

void FilterGraph::push(AVFrame& frame) {
    frame.pts = pushed_++;
    check(av_buffersrc_add_frame_flags(source_, &frame, AV_BUFFERSRC_FLAG_KEEP_REF));
}

void FilterGraph::end() {
    check(av_buffersrc_add_frame_flags(source_, nullptr, 0));
}

AvFramePtr FilterGraph::pull() {
    AvFramePtr frame(av_frame_alloc());
    const int code = av_buffersink_get_frame(sink_, frame.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return nullptr;
    check(code);
    return frame;
}

}  // namespace grainreel

#include "render/film/codec/filter_graph.hpp"

#include <dlfcn.h>

extern "C" {
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavutil/pixdesc.h>
}

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

void check(int code) {
    if (code < 0) throw RunError(fmt::format("film: a filter of FFmpeg failed: {}", ffmpeg_error(code)));
}

// libavfilter is loaded when the first filter is needed. It brings some sixty libraries of its own, which
// would take a third of the start of every command (17 of 58 ms).
class Library {
    void* const library_ =
        dlopen(fmt::format("libavfilter.so.{}", LIBAVFILTER_VERSION_MAJOR).c_str(), RTLD_NOW);

    template <class Function>
    Function* find(Function*, const char* name) const {
        void* const found = library_ ? dlsym(library_, name) : nullptr;
        if (found) return reinterpret_cast<Function*>(found);
        throw RunError(
            fmt::format("film: FFmpeg's libavfilter is missing ({}); install it again", dlerror()));
    }

  public:
#define GRAINREEL_FIND(function) \
    decltype(&::function) function = find(decltype (&::function)(nullptr), #function)
    GRAINREEL_FIND(avfilter_graph_alloc);
    GRAINREEL_FIND(avfilter_graph_free);
    GRAINREEL_FIND(avfilter_graph_parse2);
    GRAINREEL_FIND(avfilter_inout_free);
    GRAINREEL_FIND(avfilter_graph_config);
    GRAINREEL_FIND(avfilter_graph_get_filter);
    GRAINREEL_FIND(av_buffersrc_add_frame_flags);
    GRAINREEL_FIND(av_buffersink_get_frame);
#undef GRAINREEL_FIND
};

const Library& library() {
    static const Library loaded;
    return loaded;
}

std::string source(const char* name, int width, int height, int pixels) {
    return fmt::format("buffer@{}=video_size={}x{}:pix_fmt={}:time_base=1/1", name, width, height, pixels);
}

}  // namespace

void FilterGraph::Free::operator()(AVFilterGraph* graph) const {
    library().avfilter_graph_free(&graph);
}

FilterGraph::FilterGraph(const AVCodecContext& codec, const std::string& filter, const AVFrame* second)
    : graph_(library().avfilter_graph_alloc()) {
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
        library().avfilter_graph_parse2(graph_.get(), (text + ",buffersink@out").c_str(), &inputs, &outputs);
    library().avfilter_inout_free(&inputs);
    library().avfilter_inout_free(&outputs);
    check(code);
    check(library().avfilter_graph_config(graph_.get(), nullptr));
    source_ = library().avfilter_graph_get_filter(graph_.get(), "buffer@first");
    sink_ = library().avfilter_graph_get_filter(graph_.get(), "buffersink@out");
    if (!second) return;
    AVFilterContext* still = library().avfilter_graph_get_filter(graph_.get(), "buffer@second");
    const AvFramePtr copy(av_frame_clone(second));
    check(copy ? 0 : AVERROR(ENOMEM));
    copy->pts = 0;
    check(library().av_buffersrc_add_frame_flags(still, copy.get(), 0));
    check(library().av_buffersrc_add_frame_flags(still, nullptr, 0));
}

void FilterGraph::push(AVFrame& frame) {
    frame.pts = pushed_++;
    check(library().av_buffersrc_add_frame_flags(source_, &frame, AV_BUFFERSRC_FLAG_KEEP_REF));
}

void FilterGraph::end() {
    check(library().av_buffersrc_add_frame_flags(source_, nullptr, 0));
}

AvFramePtr FilterGraph::pull() {
    AvFramePtr frame(av_frame_alloc());
    const int code = library().av_buffersink_get_frame(sink_, frame.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return nullptr;
    check(code);
    return frame;
}

}  // namespace grainreel

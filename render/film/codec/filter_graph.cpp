#include "render/film/codec/filter_graph.hpp"

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

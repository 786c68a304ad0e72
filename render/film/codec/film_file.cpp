#include "render/film/codec/film_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/codec/ffmpeg.hpp"

namespace grainreel {

FilmReader::FilmReader(const std::filesystem::path& path, int threads)
    : path_(path), packet_(av_packet_alloc()), frame_(av_frame_alloc()) {
    check(open_film(path, file_));
    check(avformat_find_stream_info(file_.get(), nullptr));
    const AVCodecParameters& parameters = *file_->streams[0]->codecpar;
    codec_.reset(avcodec_alloc_context3(avcodec_find_decoder(parameters.codec_id)));
    check(codec_ && packet_ && frame_ ? 0 : AVERROR(ENOMEM));
    check(avcodec_parameters_to_context(codec_.get(), &parameters));
    codec_->thread_count = threads;
    check(avcodec_open2(codec_.get(), nullptr, nullptr));
}

AVFrame* FilmReader::next() {
    int code = 0;
    while ((code = avcodec_receive_frame(codec_.get(), frame_.get())) == AVERROR(EAGAIN))
        if (!feed()) check(avcodec_send_packet(codec_.get(), nullptr));
    if (code == AVERROR_EOF) return nullptr;
    check(code);
    return frame_.get();
}

// Gives the decoder one more packet; false when there is none.
bool FilmReader::feed() {
    const int code = av_read_frame(file_.get(), packet_.get());
    if (code == AVERROR_EOF) return false;
    check(code);
    check(avcodec_send_packet(codec_.get(), packet_.get()));
    av_packet_unref(packet_.get());
    return true;
}

std::int64_t pictures_in(const std::filesystem::path& film) {
    const auto check = [&](int code) {
        if (code < 0) throw RunError("{}: cannot be read back: {}", film.string(), ffmpeg_error(code));
    };
    InputPtr file;
    check(open_film(film, file));
    const PacketPtr packet(av_packet_alloc());
    check(packet ? 0 : AVERROR(ENOMEM));
    std::int64_t count = 0;
    while (av_read_frame(file.get(), packet.get()) >= 0) {
        count += packet->stream_index == 0 && (packet->flags & AV_PKT_FLAG_CORRUPT) == 0;
        av_packet_unref(packet.get());
    }
    return count;
}

double frame_rate_of(const std::filesystem::path& film) {
    InputPtr file;
    if (const int code = open_film(film, file); code < 0)
        throw RunError("{}: cannot be read back: {}", film.string(), ffmpeg_error(code));
    if (file->nb_streams == 0) return 0;
    const AVStream& stream = *file->streams[0];
    const AVRational rate = stream.avg_frame_rate.den > 0 ? stream.avg_frame_rate : stream.r_frame_rate;
    return rate.den > 0 ? static_cast<double>(rate.num) / rate.den : 0;
}

void FilmReader::check(int code) const {
    if (code < 0) throw RunError("{}: cannot be read back: {}", path_.string(), ffmpeg_error(code));
}

namespace {

int open_output(const AVFormatContext& input, const std::filesystem::path& path,
                const FilmContainer& container, OutputPtr& output) {
    AVFormatContext* context = nullptr;
    int code = avformat_alloc_output_context2(&context, nullptr, container.muxer, ffmpeg_url(path).c_str());
    output.reset(context);
    if (code < 0) return code;
    const AVStream& from = *input.streams[0];
    AVStream* to = avformat_new_stream(context, nullptr);
    if (!to) return AVERROR(ENOMEM);
    code = avcodec_parameters_copy(to->codecpar, from.codecpar);
    if (code < 0) return code;
    to->codecpar->codec_tag = 0;
    to->time_base = from.time_base;
    to->avg_frame_rate = from.avg_frame_rate;
    av_dict_copy(&context->metadata, input.metadata, 0);
    context->flags |= AVFMT_FLAG_BITEXACT;
    AvOptions options;
    for (const auto& [key, value] : container.complete) options.set(key, value);
    code = avio_open(&context->pb, context->url, AVIO_FLAG_WRITE);
    return code < 0 ? code : avformat_write_header(context, options.get());
}

int copy_packets(AVFormatContext& input, AVFormatContext& output) {
    const PacketPtr packet(av_packet_alloc());
    if (!packet) return AVERROR(ENOMEM);
    // The first picture may be shown some frames after the time 0 of coding. A fragmented file cannot note
    // this delay; the new file can.
    std::int64_t start = AV_NOPTS_VALUE;
    int code = 0;
    while ((code = av_read_frame(&input, packet.get())) >= 0) {
        if (start == AV_NOPTS_VALUE) start = packet->pts;
        packet->pts -= start;
        packet->dts -= start;
        av_packet_rescale_ts(packet.get(), input.streams[0]->time_base, output.streams[0]->time_base);
        packet->pos = -1;
        code = av_write_frame(&output, packet.get());
        av_packet_unref(packet.get());
        if (code < 0) return code;
    }
    return code == AVERROR_EOF ? 0 : code;
}

int write_copy(const std::filesystem::path& from, const std::filesystem::path& to,
               const FilmContainer& container) {
    InputPtr input;
    OutputPtr output;
    make_way(to);
    int code = open_film(from, input);
    if (code >= 0) code = open_output(*input, to, container, output);
    if (code >= 0) code = copy_packets(*input, *output);
    if (code >= 0) code = av_write_trailer(output.get());
    if (code >= 0) code = avio_closep(&output->pb);
    return code;
}

// Syncs a file or a folder to disk. Returns 0 or a negative error.
int sync(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return AVERROR(errno);
    const int code = ::fsync(descriptor) == 0 ? 0 : AVERROR(errno);
    ::close(descriptor);
    return code;
}

}  // namespace

std::string ffmpeg_url(const std::filesystem::path& path) {
    return "file:" + path.string();
}

int replace_synced(const std::filesystem::path& from, const std::filesystem::path& to) {
    const int code = sync(from);
    if (code < 0) return code;
    std::error_code renamed;
    std::filesystem::rename(from, to, renamed);
    if (renamed) return AVERROR(renamed.value());
    sync(std::filesystem::absolute(to)
             .parent_path());  // syncs the new name; if that fails the film is no worse off
    return 0;
}

int open_film(const std::filesystem::path& path, InputPtr& input) {
    if (!other_than_file(path, true).empty()) return AVERROR(EINVAL);
    AVFormatContext* context = nullptr;
    const int code = avformat_open_input(&context, ffmpeg_url(path).c_str(), nullptr, nullptr);
    input.reset(context);
    return code;
}

void remux_for_streaming(const std::filesystem::path& path, const FilmContainer& container) {
    const std::filesystem::path part = path.string() + ".part";
    int code = write_copy(path, part, container);
    if (code >= 0) code = replace_synced(part, path);
    if (code >= 0) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw RunError("{}: cannot put the index in front: {}; the film on disk is whole and plays",
                   path.string(), ffmpeg_error(code));
}

}  // namespace grainreel

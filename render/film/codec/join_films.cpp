#include "render/film/codec/join_films.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/codec/film_file.hpp"

namespace grainreel {

PieceReader::PieceReader(const FilmPiece& piece, AVRational rate)
    : piece_(piece), frame_time_(av_inv_q(rate)) {
    // A coded frame has at least one byte, so a file cannot hold more frames than bytes, whatever it says of
    // its length.
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(piece.file, error);
    if (error) fail(error.message());
    if (piece.frames < 1 || static_cast<std::uintmax_t>(piece.frames) > size)
        fail(fmt::format("has {} bytes, too few for its {} pictures", size, piece.frames));
    const int code = open_film(piece.file, file_);
    if (code < 0) fail("cannot be read: " + ffmpeg_error(code));
    if (file_->nb_streams != 1 || stream().codecpar->codec_type != AVMEDIA_TYPE_VIDEO)
        fail("is no film of ours");
    came_.resize(static_cast<std::size_t>(piece.frames), false);
}

void PieceReader::fail(const std::string& what) const {
    throw UserError("{}: {}; draw that part again", piece_.name, what);
}

bool PieceReader::next(AVPacket& packet) {
    const int code = av_read_frame(file_.get(), &packet);
    if (code < 0 && code != AVERROR_EOF) fail("cannot be read: " + ffmpeg_error(code));
    if (code == AVERROR_EOF) {
        if (place_ + 1 < piece_.frames)
            fail(fmt::format("has {} pictures, but its run.json says {}", place_ + 1, piece_.frames));
        return false;
    }
    take(packet);
    return true;
}

void PieceReader::take(const AVPacket& packet) {
    if ((packet.flags & AV_PKT_FLAG_CORRUPT) != 0 || packet.size <= 0) fail("is damaged");
    if (packet.pts == AV_NOPTS_VALUE) fail("has a picture without a time");
    if (++place_ == piece_.frames)
        fail(fmt::format("has more pictures than the {} that its run.json says", piece_.frames));
    if (place_ == 0 && (packet.flags & AV_PKT_FLAG_KEY) == 0) fail("does not begin with a key frame");
    const AVRational base = stream().time_base;
    frame_ = av_rescale_q(packet.pts, base, frame_time_);
    const bool in_piece = frame_ >= 0 && frame_ < piece_.frames;
    if (!in_piece || std::abs(av_rescale_q(frame_, frame_time_, base) - packet.pts) > 1)
        fail(fmt::format("has a picture at {:.6g} s, where its rate has none",
                         static_cast<double>(packet.pts) * av_q2d(base)));
    if (came_[frame_]) fail("has two pictures at one time");
    came_[frame_] = true;
    if (place_ == 0 && packet.dts != AV_NOPTS_VALUE)
        delay_ = frame_ - av_rescale_q(packet.dts, base, frame_time_);
}

namespace {

bool same_coding(const AVCodecParameters& a, const AVCodecParameters& b) {
    return a.codec_id == b.codec_id && a.width == b.width && a.height == b.height && a.format == b.format &&
           a.profile == b.profile && a.level == b.level && a.extradata_size == b.extradata_size &&
           std::equal(a.extradata, a.extradata + a.extradata_size, b.extradata);
}

// The joined film while it is written. Its file is removed if finish() is not called.
class Joined {
  public:
    Joined(std::filesystem::path path, const Codec& codec, AVRational rate)
        : path_(std::move(path)), container_(codec.container), frame_time_(av_inv_q(rate)) {}
    ~Joined() {
        if (!begun_) return;
        output_.reset();
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    Joined(const Joined&) = delete;
    Joined& operator=(const Joined&) = delete;

    // To be called when the first packet of the first piece has been read.
    void begin(const PieceReader& like);
    // Adds a packet of the piece `of`. before: number of the film's frames in the pieces before this one.
    void add(AVPacket& packet, const PieceReader& of, std::int64_t before);
    void finish(const std::filesystem::path& to);

  private:
    void check(int code) const {
        if (code < 0) throw RunError("{}: cannot be written: {}", path_.string(), ffmpeg_error(code));
    }

    const std::filesystem::path path_;
    const FilmContainer& container_;
    const AVRational frame_time_;
    OutputPtr output_;
    std::int64_t delay_ = 0, bytes_ = 0, duration_ = 0;  // delay, bytes and duration of the packets
    bool begun_ = false;
};

void Joined::begin(const PieceReader& like) {
    make_way(path_);
    AVFormatContext* context = nullptr;
    const int code =
        avformat_alloc_output_context2(&context, nullptr, container_.muxer, ffmpeg_url(path_).c_str());
    output_.reset(context);
    check(code);
    const AVStream& from = like.stream();
    AVStream* const to = avformat_new_stream(context, nullptr);
    check(to ? 0 : AVERROR(ENOMEM));
    check(avcodec_parameters_copy(to->codecpar, from.codecpar));
    to->codecpar->codec_tag = 0;
    to->time_base = from.time_base;
    to->avg_frame_rate = from.avg_frame_rate;
    av_dict_copy(&context->metadata, like.file().metadata, 0);
    context->flags |= AVFMT_FLAG_BITEXACT;
    AvOptions options;
    for (const auto& [key, value] : container_.complete.empty() ? container_.growing : container_.complete)
        options.set(key, value);
    begun_ = true;
    check(avio_open(&context->pb, context->url, AVIO_FLAG_WRITE));
    check(avformat_write_header(context, options.get()));
    delay_ = like.delay();
}

void Joined::add(AVPacket& packet, const PieceReader& of, std::int64_t before) {
    const AVRational base = output_->streams[0]->time_base;
    packet.pts = av_rescale_q(before + of.frame(), frame_time_, base);
    packet.dts = av_rescale_q(before + of.place() - delay_, frame_time_, base);
    packet.duration = av_rescale_q(packet.duration, of.stream().time_base, base);
    packet.pos = -1;
    bytes_ += packet.size;
    duration_ += packet.duration;
    packet.stream_index = 0;
    check(av_write_frame(output_.get(), &packet));
}

void Joined::finish(const std::filesystem::path& to) {
    // MP4 has the bit rate in its index. It must be that of the whole film, not of a piece.
    AVStream& film = *output_->streams[0];
    if (duration_ > 0)
        film.codecpar->bit_rate =
            av_rescale(bytes_, std::int64_t{8} * film.time_base.den, duration_ * film.time_base.num);
    check(av_write_trailer(output_.get()));
    check(avio_closep(&output_->pb));
    check(replace_synced(path_, to));
    begun_ = false;
}

}  // namespace

JoinEnd join_films(const std::vector<FilmPiece>& pieces, const Codec& codec, double rate,
                   const std::filesystem::path& to, const std::function<bool()>& go_on) {
    quiet_ffmpeg();
    const AVRational frames = av_d2q(rate, 100'000);
    const PacketPtr packet(av_packet_alloc());
    if (!packet) throw RunError("film: no memory for a packet");
    GRAINREEL_CHECK(!pieces.empty());
    const PieceReader first(pieces.front(), frames);
    Joined film(to.string() + ".part", codec, frames);
    std::int64_t before = 0, delay = 0;
    for (const FilmPiece& piece : pieces) {
        PieceReader reader(piece, frames);
        if (!same_coding(*reader.stream().codecpar, *first.stream().codecpar))
            throw UserError("{}: is coded otherwise than {}", piece.name, pieces.front().name);
        while (reader.next(*packet)) {
            if (!go_on()) return JoinEnd::stopped;
            if (reader.place() == 0 && before == 0) {
                film.begin(reader);
                delay = reader.delay();
            }
            if (reader.delay() != delay || reader.place() - delay > reader.frame())
                throw UserError("{}: its pictures are coded in another order than those of {}", piece.name,
                                pieces.front().name);
            film.add(*packet, reader, before);
            av_packet_unref(packet.get());
        }
        before += piece.frames;
    }
    film.finish(to);
    return JoinEnd::joined;
}

}  // namespace grainreel

// The words that scenes use for choices of their film, once for the reader, the writer and the list of keys.
#pragma once

#include "engine/scene/keys/keys.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

inline const Words<FilmLook::Style> style_words{
    {"studio", FilmLook::Style::studio}, {"flat", FilmLook::Style::flat}, {"dark", FilmLook::Style::dark}};
inline const Words<CameraFrame> camera_frame_words{
    {"container", CameraFrame::container}, {"bed", CameraFrame::bed}, {"reach", CameraFrame::reach}};
inline const Words<WordPlace> word_place_words{{"automatic", WordPlace::automatic},
                                               {"gutters", WordPlace::gutters},
                                               {"plates", WordPlace::plates},
                                               {"none", WordPlace::none}};
inline const Words<FilmFormat> film_format_words{{"mp4", FilmFormat::mp4},   {"webm", FilmFormat::webm},
                                                 {"av1", FilmFormat::av1},   {"gif", FilmFormat::gif},
                                                 {"ffv1", FilmFormat::ffv1}, {"png", FilmFormat::png},
                                                 {"y4m", FilmFormat::y4m}};

}  // namespace grainreel

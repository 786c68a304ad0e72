// The table of fixed words.
#include "render/scene/wording.hpp"

#include <algorithm>
#include <array>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

struct Row {
    Word word;
    const char* name;
    std::array<const char*, 4> texts;  // en, de, fr, es
};

constexpr std::size_t count = static_cast<std::size_t>(Word::end_of_table);

constexpr std::array<Row, count> table{{
    // Signs beside the picture.
    {Word::gravity, "gravity", {"gravity", "Schwerkraft", "pesanteur", "gravedad"}},
    {Word::vibration, "vibration", {"vibration", "Vibration", "vibration", "vibración"}},
    {Word::floor_vibrates,
     "floor_vibrates",
     {"floor vibrates", "Boden vibriert", "le fond vibre", "el fondo vibra"}},
    {Word::floor, "floor", {"floor", "Boden", "fond", "fondo"}},
    {Word::at_rest, "at_rest", {"at rest", "in Ruhe", "au repos", "en reposo"}},
    {Word::taps, "taps", {"taps of {1}", "Stöße mit {1}", "chocs à {1}", "golpes a {1}"}},
    {Word::tap_interval, "tap_interval", {"every {1}", "alle {1}", "toutes les {1}", "cada {1}"}},
    {Word::before_the_drive,
     "before_the_drive",
     {"before the drive", "vor dem Antrieb", "avant l’excitation", "antes de la excitación"}},
    {Word::settling,
     "settling",
     {"settling, drive off", "setzt sich, Antrieb aus", "dépôt, excitation coupée",
      "asentamiento, excitación apagada"}},
    {Word::cycle, "cycle", {"cycle {1}", "Periode {1}", "cycle {1}", "ciclo {1}"}},
    {Word::phase, "phase", {"phase {1}", "Phase {1}", "phase {1}", "fase {1}"}},
    // How time passes.
    {Word::real_time, "real_time", {"real time", "Echtzeit", "temps réel", "tiempo real"}},
    {Word::slow_motion,
     "slow_motion",
     {"slow motion, {1} speed", "Zeitlupe, {1} der Geschwindigkeit", "ralenti, {1} de la vitesse",
      "cámara lenta, {1} de la velocidad"}},
    {Word::time_lapse,
     "time_lapse",
     {"time lapse, {1}× speed", "Zeitraffer, {1}× so schnell", "accéléré, {1}× plus vite",
      "cámara rápida, {1}× la velocidad"}},
    {Word::on_average,
     "on_average",
     {"on average {1}", "im Mittel {1}", "en moyenne {1}", "en promedio {1}"}},
    {Word::frame_a_period,
     "frame_a_period",
     {"1 frame a period at phase {1}", "1 Bild je Periode bei Phase {1}",
      "1 image par période à la phase {1}", "1 imagen por periodo en la fase {1}"}},
    {Word::frame_every,
     "frame_every",
     {"1 frame every {1} periods at phase {2}", "1 Bild alle {1} Perioden bei Phase {2}",
      "1 image toutes les {1} périodes à la phase {2}", "1 imagen cada {1} periodos en la fase {2}"}},
    {Word::moment_a_period,
     "moment_a_period",
     {"1 moment a period at phase {1}", "1 Moment je Periode bei Phase {1}",
      "1 instant par période à la phase {1}", "1 instante por periodo en la fase {1}"}},
    {Word::moment_every,
     "moment_every",
     {"1 moment every {1} periods at phase {2}", "1 Moment alle {1} Perioden bei Phase {2}",
      "1 instant toutes les {1} périodes à la phase {2}", "1 instante cada {1} periodos en la fase {2}"}},
    {Word::plays, "plays", {"plays {1}×", "läuft {1}×", "défile à {1}×", "avanza a {1}×"}},
    {Word::mean_of_a_period,
     "mean_of_a_period",
     {"mean of a period", "Mittel über eine Periode", "moyenne sur une période", "media de un periodo"}},
    {Word::mean_of_periods,
     "mean_of_periods",
     {"mean of {1} periods", "Mittel über {1} Perioden", "moyenne sur {1} périodes",
      "media de {1} periodos"}},
    {Word::exposed, "exposed", {"exposed for {1}", "{1} belichtet", "pose de {1}", "exposición de {1}"}},
    {Word::wall_motion,
     "wall_motion",
     {"wall motion", "Bewegung der Wände", "mouvement des parois", "movimiento de las paredes"}},
    {Word::drawn_larger, "drawn_larger", {"drawn {1}×", "{1}× gezeichnet", "dessiné {1}×", "dibujado {1}×"}},
    // Numbers of grains.
    {Word::in_the_tray,
     "in_the_tray",
     {"{1} of {2} in the tray", "{1} von {2} in der Schale", "{1} sur {2} dans le bac",
      "{1} de {2} en la bandeja"}},
    {Word::out, "out", {"{1} out", "{1} ausgeflossen", "{1} écoulés", "{1} han salido"}},
    {Word::out_of,
     "out_of",
     {"{1} of {2} out", "{1} von {2} ausgeflossen", "{1} sur {2} écoulés", "{1} de {2} han salido"}},
    {Word::at_the_start,
     "at_the_start",
     {"{1} at the start", "{1} am Anfang", "{1} au départ", "{1} al inicio"}},
    {Word::fed, "fed", {"{1}, fed", "{1}, zugeführt", "{1}, alimentés", "{1}, alimentados"}},
    {Word::more_fed,
     "more_fed",
     {"{1} more are fed", "{1} weitere werden zugeführt", "{1} autres sont ajoutés", "se añaden {1} más"}},
    {Word::glued,
     "glued",
     {"{1}, glued to walls", "{1}, an die Wände geklebt", "{1}, collés aux parois",
      "{1}, pegados a las paredes"}},
    {Word::more_species, "more_species", {"and {1} more", "und {1} weitere", "et {1} autres", "y {1} más"}},
    {Word::grain, "grain", {"grain {1}", "Korn {1}", "grain {1}", "grano {1}"}},
    {Word::grains, "grains", {"grains {1}", "Körner {1}", "grains {1}", "granos {1}"}},
    {Word::number_of_grains, "number_of_grains", {"{1} grains", "{1} Körner", "{1} grains", "{1} granos"}},
    // Marks over the grains.
    {Word::paths,
     "paths",
     {"paths of the last {1}", "Wege der letzten {1}", "trajets pendant {1}", "recorridos durante {1}"}},
    {Word::mean_velocity,
     "mean_velocity",
     {"mean velocity", "mittlere Geschwindigkeit", "vitesse moyenne", "velocidad media"}},
    {Word::over_a_period,
     "over_a_period",
     {"{1} over a period", "{1} über eine Periode", "{1} sur une période", "{1} en un periodo"}},
    {Word::over_periods,
     "over_periods",
     {"{1} over {2} periods", "{1} über {2} Perioden", "{1} sur {2} périodes", "{1} en {2} periodos"}},
    {Word::streamlines,
     "streamlines",
     {"streamlines", "Stromlinien", "lignes de courant", "líneas de corriente"}},
    {Word::this_wide,
     "this_wide",
     {"{1}, this wide from {2} on", "{1}, so breit ab {2}", "{1}, de cette largeur dès {2}",
      "{1}, de este ancho desde {2}"}},
    {Word::force_on_wall,
     "force_on_wall",
     {"mean force on a wall", "mittlere Kraft auf eine Wand", "force moyenne sur une paroi",
      "fuerza media sobre una pared"}},
    {Word::contact_force,
     "contact_force",
     {"contact force, {1} or more", "Kontaktkraft, {1} oder mehr", "force de contact, {1} ou plus",
      "fuerza de contacto, {1} o más"}},
    // Axes of plots.
    {Word::time, "time", {"time", "Zeit", "temps", "tiempo"}},
    {Word::height, "height", {"height", "Höhe", "hauteur", "altura"}},
    {Word::across, "across", {"across", "quer", "en largeur", "a lo ancho"}},
    {Word::solid_fraction,
     "solid_fraction",
     {"solid fraction", "Feststoffanteil", "fraction solide", "fracción sólida"}},
    {Word::share,
     "share",
     {"share of the solid volume", "Anteil am Feststoffvolumen", "part du volume solide",
      "parte del volumen sólido"}},
    {Word::horizontal_velocity,
     "horizontal_velocity",
     {"horizontal velocity", "waagrechte Geschwindigkeit", "vitesse horizontale", "velocidad horizontal"}},
    {Word::vertical_velocity,
     "vertical_velocity",
     {"vertical velocity", "senkrechte Geschwindigkeit", "vitesse verticale", "velocidad vertical"}},
    // Colour bars.
    {Word::speed, "speed", {"speed", "Geschwindigkeit", "vitesse", "rapidez"}},
    {Word::upward_velocity,
     "upward_velocity",
     {"upward velocity", "Geschwindigkeit nach oben", "vitesse vers le haut", "velocidad hacia arriba"}},
    {Word::start_height,
     "start_height",
     {"height at the start", "Höhe am Anfang", "hauteur au départ", "altura inicial"}},
    {Word::displacement,
     "displacement",
     {"displacement in a period", "Weg in einer Periode", "déplacement en une période",
      "desplazamiento en un periodo"}},
    {Word::rise,
     "rise",
     {"rise in a period", "Anstieg in einer Periode", "montée en une période", "subida en un periodo"}},
    {Word::spin, "spin", {"spin", "Drehgeschwindigkeit", "vitesse de rotation", "velocidad de giro"}},
    {Word::kinetic_energy,
     "kinetic_energy",
     {"kinetic energy", "kinetische Energie", "énergie cinétique", "energía cinética"}},
    {Word::contacts,
     "contacts",
     {"contacts of a grain", "Kontakte eines Korns", "contacts d’un grain", "contactos de un grano"}},
    {Word::normal_forces,
     "normal_forces",
     {"normal forces on a grain", "Normalkräfte auf ein Korn", "forces normales sur un grain",
      "fuerzas normales sobre un grano"}},
    {Word::wear,
     "wear",
     {"wear of walls", "Verschleiß der Wände", "usure des parois", "desgaste de las paredes"}},
    {Word::pressure,
     "pressure",
     {"pressure on walls", "Druck auf die Wände", "pression sur les parois", "presión sobre las paredes"}},
    // Headings of panels.
    {Word::no_vibration,
     "no_vibration",
     {"no vibration", "keine Vibration", "sans vibration", "sin vibración"}},
    {Word::changing_drive,
     "changing_drive",
     {"drive that changes, at first", "wechselnder Antrieb, zuerst", "excitation variable, d’abord",
      "excitación variable, al principio"}},
}};

const Row& row_of(Word word) {
    const Row& row = table[static_cast<std::size_t>(word)];
    GRAINREEL_CHECK(row.word == word);
    return row;
}

bool is_part(std::string_view text, std::size_t at) {
    return at + 2 < text.size() && text[at] == '{' && text[at + 1] >= '1' && text[at + 1] <= '9' &&
           text[at + 2] == '}';
}

}  // namespace

std::string Wording::operator()(Word word, std::initializer_list<std::string_view> parts) const {
    const auto mine =
        std::find_if(own.begin(), own.end(), [&](const OwnWord& one) { return one.word == word; });
    const std::string_view pattern =
        mine != own.end() ? std::string_view(mine->text)
                          : std::string_view(row_of(word).texts[static_cast<std::size_t>(language)]);
    std::string text;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (!is_part(pattern, i)) {
            text += pattern[i];
            continue;
        }
        const auto part = static_cast<std::size_t>(pattern[i + 1] - '1');
        GRAINREEL_CHECK(part < parts.size());
        text += parts.begin()[part];
        i += 2;
    }
    return text;
}

const std::vector<std::pair<std::string, Language>>& language_words() {
    static const std::vector<std::pair<std::string, Language>> words{
        {"en", Language::en}, {"de", Language::de}, {"fr", Language::fr}, {"es", Language::es}};
    return words;
}

const char* name_of(Word word) {
    return row_of(word).name;
}

const char* english_of(Word word) {
    return row_of(word).texts[0];
}

int parts_in(std::string_view text) {
    int most = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '}') return -1;
        if (text[i] != '{') continue;
        if (!is_part(text, i)) return -1;
        most = std::max(most, text[i + 1] - '0');
        i += 2;
    }
    return most;
}

}  // namespace grainreel

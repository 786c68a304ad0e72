// The table of phrases: labels of columns. The English text is the key.
#include <array>
#include <map>
#include <string_view>

#include "render/scene/wording.hpp"

namespace grainreel {
namespace {

struct Row {
    const char* english;
    std::array<const char*, 3> others;  // de, fr, es
};

// {1} stands for a name.
constexpr Row phrases[] = {
    // Columns of measures.csv (engine/measure).
    {"height of big − small, in bed heights",
     {"Höhe groß − klein, in Betthöhen", "hauteur gros − petits, en hauteurs du lit",
      "altura grandes − pequeños, en alturas del lecho"}},
    {"P(big above small)", {"P(groß über klein)", "P(gros au-dessus de petit)", "P(grande sobre pequeño)"}},
    {"share of big grains in the top quarter",
     {"Anteil großer Körner im obersten Viertel", "part des gros grains dans le quart supérieur",
      "parte de los granos grandes en el cuarto superior"}},
    {"share of big grains in the bottom quarter",
     {"Anteil großer Körner im untersten Viertel", "part des gros grains dans le quart inférieur",
      "parte de los granos grandes en el cuarto inferior"}},
    {"share of big grains at the walls",
     {"Anteil großer Körner an den Wänden", "part des gros grains aux parois",
      "parte de los granos grandes junto a las paredes"}},
    {"Lacey mixing index",
     {"Mischungsindex nach Lacey", "indice de mélange de Lacey", "índice de mezcla de Lacey"}},
    {"intensity of segregation",
     {"Intensität der Entmischung", "intensité de ségrégation", "intensidad de segregación"}},
    {"unlike pairs / chance",
     {"ungleiche Paare / Zufall", "paires dissemblables / hasard", "pares distintos / azar"}},
    {"height of the bed", {"Höhe des Betts", "hauteur du lit", "altura del lecho"}},
    {"solid fraction of the bed",
     {"Feststoffanteil des Betts", "fraction solide du lit", "fracción sólida del lecho"}},
    {"expansion of the bed", {"Ausdehnung des Betts", "expansion du lit", "expansión del lecho"}},
    {"phase of take-off (turns)",
     {"Phase des Abhebens (Umdrehungen)", "phase du décollage (tours)", "fase de despegue (vueltas)"}},
    {"phase of landing (turns)",
     {"Phase der Landung (Umdrehungen)", "phase de l’atterrissage (tours)", "fase de aterrizaje (vueltas)"}},
    {"time of flight (periods)",
     {"Flugzeit (Perioden)", "temps de vol (périodes)", "tiempo de vuelo (periodos)"}},
    {"periods until the bed repeats itself",
     {"Perioden, bis sich das Bett wiederholt", "périodes avant que le lit se répète",
      "periodos hasta que el lecho se repite"}},
    {"difference between periods",
     {"Unterschied zwischen Perioden", "différence entre périodes", "diferencia entre periodos"}},
    {"centre of mass, x", {"Schwerpunkt, x", "centre de masse, x", "centro de masas, x"}},
    {"centre of mass, y", {"Schwerpunkt, y", "centre de masse, y", "centro de masas, y"}},
    {"centre of mass, z", {"Schwerpunkt, z", "centre de masse, z", "centro de masas, z"}},
    {"mean height of {1}", {"mittlere Höhe: {1}", "hauteur moyenne : {1}", "altura media: {1}"}},
    {"centre of {1}", {"Mitte: {1}", "centre : {1}", "centro: {1}"}},
    {"contacts per grain", {"Kontakte je Korn", "contacts par grain", "contactos por grano"}},
    {"largest overlap / radius",
     {"größte Überlappung / Radius", "recouvrement maximal / rayon", "solapamiento máximo / radio"}},
    {"fabric anisotropy",
     {"Anisotropie der Kontakte", "anisotropie des contacts", "anisotropía de los contactos"}},
    {"vertical fabric",
     {"senkrechter Anteil der Kontakte", "part verticale des contacts", "parte vertical de los contactos"}},
    {"level of the intruder", {"Lage des Eindringlings", "niveau de l’intrus", "nivel del intruso"}},
    {"rise time", {"Steigzeit", "temps de montée", "tiempo de subida"}},
    {"time", {"Zeit", "temps", "tiempo"}},
    {"width", {"Breite", "largeur", "ancho"}},
    {"depth", {"Tiefe", "profondeur", "profundidad"}},
    {"height", {"Höhe", "hauteur", "altura"}},
    {"diameter", {"Durchmesser", "diamètre", "diámetro"}},
    {"count", {"Anzahl", "nombre", "número"}},
    {"density", {"Dichte", "masse volumique", "densidad"}},
    {"friction", {"Reibung", "frottement", "rozamiento"}},
    {"restitution", {"Stoßzahl", "restitution", "restitución"}},
    {"frequency", {"Frequenz", "fréquence", "frecuencia"}},
    {"amplitude", {"Amplitude", "amplitude", "amplitud"}},
    {"seed", {"Startwert", "graine", "semilla"}},
    {"phase (turns)", {"Phase (Umdrehungen)", "phase (tours)", "fase (vueltas)"}},
    {"periods", {"Perioden", "périodes", "periodos"}},
    {"drive frequency", {"Frequenz des Antriebs", "fréquence d’excitation", "frecuencia de excitación"}},
    {"Γ of the drive", {"Γ des Antriebs", "Γ de l’excitation", "Γ de la excitación"}},
    {"floor position", {"Ort des Bodens", "position du fond", "posición del fondo"}},
    {"kinetic energy", {"kinetische Energie", "énergie cinétique", "energía cinética"}},
    {"energy of rotation", {"Rotationsenergie", "énergie de rotation", "energía de rotación"}},
    {"potential energy", {"potentielle Energie", "énergie potentielle", "energía potencial"}},
    {"elastic energy", {"elastische Energie", "énergie élastique", "energía elástica"}},
    {"work of the walls", {"Arbeit der Wände", "travail des parois", "trabajo de las paredes"}},
    {"energy lost", {"verlorene Energie", "énergie dissipée", "energía disipada"}},
    {"energy lost to friction",
     {"durch Reibung verlorene Energie", "énergie dissipée par frottement",
      "energía disipada por rozamiento"}},
    {"energy lost to dashpots",
     {"durch Dämpfer verlorene Energie", "énergie dissipée par les amortisseurs",
      "energía disipada por los amortiguadores"}},
    {"energy lost to latching",
     {"durch Einrasten verlorene Energie", "énergie dissipée par verrouillage",
      "energía disipada por enclavamiento"}},
    {"error of the energy balance",
     {"Fehler der Energiebilanz", "erreur du bilan d’énergie", "error del balance de energía"}},
    {"mass that flowed out", {"ausgeflossene Masse", "masse écoulée", "masa que ha salido"}},
    {"mass flow", {"Massenstrom", "débit massique", "caudal másico"}},
    {"time to empty", {"Zeit bis zur Leerung", "temps de vidange", "tiempo de vaciado"}},
    {"wavelength of the surface",
     {"Wellenlänge der Oberfläche", "longueur d’onde de la surface", "longitud de onda de la superficie"}},
    {"share of the largest wave",
     {"Anteil der größten Welle", "part de la plus grande onde", "parte de la onda mayor"}},
    {"roughness of the surface",
     {"Rauheit der Oberfläche", "rugosité de la surface", "rugosidad de la superficie"}},
    {"share of waves at f/2",
     {"Anteil der Wellen bei f/2", "part des ondes à f/2", "parte de las ondas a f/2"}},
    {"share of waves at f/4",
     {"Anteil der Wellen bei f/4", "part des ondes à f/4", "parte de las ondas a f/4"}},
    {"height of the mound", {"Höhe des Haufens", "hauteur du tas", "altura del montón"}},
    {"slope of the mound", {"Neigung des Haufens", "pente du tas", "pendiente del montón"}},
    {"tilt of the surface",
     {"Neigung der Oberfläche", "inclinaison de la surface", "inclinación de la superficie"}},
    {"revolutions", {"Umdrehungen", "tours", "vueltas"}},
    {"dynamic angle of repose",
     {"dynamischer Böschungswinkel", "angle de repos dynamique", "ángulo de reposo dinámico"}},
    {"Froude number", {"Froude-Zahl", "nombre de Froude", "número de Froude"}},
    {"rise at the left wall",
     {"Anstieg an der linken Wand", "montée à la paroi gauche", "subida junto a la pared izquierda"}},
    {"rise in the middle", {"Anstieg in der Mitte", "montée au milieu", "subida en el centro"}},
    {"rise at the right wall",
     {"Anstieg an der rechten Wand", "montée à la paroi droite", "subida junto a la pared derecha"}},
    {"roll of the left half", {"Rolle der linken Hälfte", "rouleau de gauche", "rollo izquierdo"}},
    {"roll of the right half", {"Rolle der rechten Hälfte", "rouleau de droite", "rollo derecho"}},
    {"centre of the left roll, {1}",
     {"Mitte der linken Rolle, {1}", "centre du rouleau de gauche, {1}", "centro del rollo izquierdo, {1}"}},
    {"centre of the right roll, {1}",
     {"Mitte der rechten Rolle, {1}", "centre du rouleau de droite, {1}", "centro del rollo derecho, {1}"}},
    {"error of the {1}", {"Fehler: {1}", "erreur : {1}", "error: {1}"}},
    {"share of {1} in the outflow",
     {"Anteil im Ausfluss: {1}", "part dans l’écoulement : {1}", "parte en la salida: {1}"}},
    {"force on {1}", {"Kraft auf {1}", "force sur {1}", "fuerza sobre {1}"}},
    {"moment on {1}", {"Moment auf {1}", "moment sur {1}", "momento sobre {1}"}},
    {"torque on {1}", {"Drehmoment auf {1}", "couple sur {1}", "par sobre {1}"}},
    {"power of {1}", {"Leistung: {1}", "puissance : {1}", "potencia: {1}"}},
    {"weight carried by {1}", {"getragenes Gewicht: {1}", "poids porté : {1}", "peso soportado: {1}"}},
    {"impact work on {1}",
     {"Stoßarbeit auf {1}", "travail des chocs sur {1}", "trabajo de impacto sobre {1}"}},
    {"shear work on {1}",
     {"Reibarbeit auf {1}", "travail de frottement sur {1}", "trabajo de rozamiento sobre {1}"}},
};

const std::map<std::string_view, const Row*>& rows() {
    static const std::map<std::string_view, const Row*> all = [] {
        std::map<std::string_view, const Row*> made;
        for (const Row& row : phrases) made.emplace(row.english, &row);
        return made;
    }();
    return all;
}

}  // namespace

std::string phrase(Language language, const std::string& english) {
    if (language == Language::en) return english;
    const std::size_t place = static_cast<std::size_t>(language) - 1;
    if (const auto row = rows().find(english); row != rows().end()) return row->second->others[place];
    constexpr std::string_view name_here = "{1}";
    for (const Row& row : phrases) {
        const std::string_view pattern = row.english;
        const std::size_t at = pattern.find(name_here);
        if (at == std::string_view::npos) continue;
        const std::string_view before = pattern.substr(0, at), after = pattern.substr(at + name_here.size());
        if (english.size() <= before.size() + after.size() || !english.starts_with(before) ||
            !english.ends_with(after))
            continue;
        std::string text = row.others[place];
        return text.replace(text.find(name_here), name_here.size(),
                            english.substr(before.size(), english.size() - before.size() - after.size()));
    }
    return english;
}

}  // namespace grainreel

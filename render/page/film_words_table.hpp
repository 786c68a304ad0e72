// The first part of the table of the page's words (page_words_table.hpp): the page itself, its film, and its
// charts.
#pragma once

#include <array>

namespace grainreel {

// The English text is the key: templates have it as [[text]], scripts as tr("text").
struct PageRow {
    const char* english;
    std::array<const char*, 3> others;  // de, fr, es
};

inline constexpr auto film_rows = std::to_array<PageRow>({
    // The page and its bar.
    {"Large print", {"Große Schrift", "Gros caractères", "Letra grande"}},
    {"Time of the run", {"Zeit des Laufs", "Temps du calcul", "Tiempo de la simulación"}},
    {"One frame back", {"Ein Bild zurück", "Une image en arrière", "Una imagen atrás"}},
    {"One frame on", {"Ein Bild weiter", "Une image en avant", "Una imagen adelante"}},
    {"Play", {"Abspielen", "Lecture", "Reproducir"}},
    {"Pause", {"Pause", "Pause", "Pausa"}},
    {"{1} s, period {2}", {"{1} s, Periode {2}", "{1} s, période {2}", "{1} s, periodo {2}"}},
    {"This page shows film, charts and bed by a script, and scripts are switched off here. The words, the "
     "pictures and "
     "the links below do without.",
     {"Film, Kurven und Schüttung zeigt diese Seite mit einem Skript, und Skripte sind hier abgeschaltet. "
      "Texte, Bilder "
      "und Verweise unten gehen ohne.",
      "Cette page montre film, courbes et lit de grains par un script, et les scripts sont désactivés ici. "
      "Les textes, "
      "les images et les liens ci-dessous s’en passent.",
      "Esta página muestra película, curvas y lecho con un script, y aquí los scripts están desactivados. "
      "Los textos, "
      "las imágenes y los enlaces de abajo no lo necesitan."}},
    {"Copy", {"Kopieren", "Copier", "Copiar"}},
    {"Copied", {"Kopiert", "Copié", "Copiado"}},
    {"Selected: copy it with Ctrl-C",
     {"Markiert: mit Strg-C kopieren", "Sélectionné : copier avec Ctrl-C",
      "Seleccionado: copiar con Ctrl-C"}},
    // The film.
    {"Film", {"Film", "Film", "Película"}},
    {"Full screen", {"Ganzer Bildschirm", "Plein écran", "Pantalla completa"}},
    {"Film of the run: {1}",
     {"Film des Laufs: {1}", "Film du calcul : {1}", "Película de la simulación: {1}"}},
    {"One picture of the run: {1}",
     {"Ein Bild des Laufs: {1}", "Une image du calcul : {1}", "Una imagen de la simulación: {1}"}},
    {"The run has no film and no poster.",
     {"Der Lauf hat weder Film noch Bild.", "Le calcul n’a ni film ni image.",
      "La simulación no tiene película ni imagen."}},
    {"Opens while this page lies there",
     {"Öffnet sich, solange die Seite dort liegt", "S’ouvre tant que la page se trouve là",
      "Se abre mientras la página esté allí"}},
    {"{1} in the run's folder",
     {"{1} im Ordner des Laufs", "{1} dans le dossier du calcul", "{1} en la carpeta de la simulación"}},
    {"Frame {1} of {2}, {3} s of the run.",
     {"Bild {1} von {2}, {3} s des Laufs.", "Image {1} sur {2}, {3} s du calcul.",
      "Imagen {1} de {2}, {3} s de la simulación."}},
    {"This browser cannot play the film.",
     {"Dieser Browser kann den Film nicht abspielen.", "Ce navigateur ne peut pas lire le film.",
      "Este navegador no puede reproducir la película."}},
    {"The film does not play: {1}.",
     {"Der Film läuft nicht: {1}.", "Le film ne démarre pas : {1}.", "La película no se reproduce: {1}."}},
    {"What to look at", {"Worauf zu achten ist", "Ce qu’il faut regarder", "Qué hay que mirar"}},
    // Measures and their charts.
    {"Measures", {"Messwerte", "Mesures", "Medidas"}},
    {"Measures, on one time axis",
     {"Messwerte, auf einer Zeitachse", "Mesures, sur un même axe de temps",
      "Medidas, en un mismo eje de tiempo"}},
    {"Zoom in", {"Vergrößern", "Agrandir", "Acercar"}},
    {"Zoom out", {"Verkleinern", "Réduire", "Alejar"}},
    {"Whole run", {"Ganzer Lauf", "Tout le calcul", "Toda la simulación"}},
    {"More", {"Mehr", "Plus", "Más"}},
    {"Add a chart…", {"Kurve hinzufügen…", "Ajouter une courbe…", "Añadir una curva…"}},
    {"Press and drag in a chart: film and bed follow. The line is their moment. Ctrl and the wheel zoom in "
     "time.",
     {"In einer Kurve drücken und ziehen: Film und Schüttung folgen. Der Strich ist ihr Moment. Strg und das "
      "Mausrad "
      "dehnen die Zeit.",
      "Appuyer et glisser dans une courbe : film et lit suivent. Le trait est leur instant. Ctrl et la "
      "molette étirent "
      "le temps.",
      "Pulsar y arrastrar en una curva: película y lecho la siguen. La línea es su instante. Ctrl y la rueda "
      "amplían el "
      "tiempo."}},
    {"Remove this chart", {"Diese Kurve entfernen", "Retirer cette courbe", "Quitar esta curva"}},
    {"Remove the chart of {1}",
     {"Die Kurve entfernen: {1}", "Retirer la courbe : {1}", "Quitar la curva: {1}"}},
    {"Download {1}", {"{1} herunterladen", "Télécharger {1}", "Descargar {1}"}},
    {"value", {"Wert", "valeur", "valor"}},
    {"no value", {"kein Wert", "aucune valeur", "sin valor"}},
    {"{1} against time: {2}.",
     {"{1} über der Zeit: {2}.", "{1} en fonction du temps : {2}.", "{1} frente al tiempo: {2}."}},
    {"at first {1}, at the end {2}, between {3} and {4}",
     {"am Anfang {1}, am Ende {2}, zwischen {3} und {4}", "au début {1}, à la fin {2}, entre {3} et {4}",
      "al principio {1}, al final {2}, entre {3} y {4}"}},
    {"mean of a period; the faint line has all rows",
     {"Mittel über eine Periode; die blasse Linie hat alle Zeilen",
      "moyenne sur une période ; le trait pâle a toutes les lignes",
      "media de un periodo; la línea tenue tiene todas las filas"}},
    {"The run has no measures.",
     {"Der Lauf hat keine Messwerte.", "Le calcul n’a pas de mesures.", "La simulación no tiene medidas."}},
});

}  // namespace grainreel

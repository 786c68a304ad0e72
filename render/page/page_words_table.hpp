// The table of the page's words, in two parts: those of the bed, of fields, runs and chapters are here, all
// others in film_words_table.hpp.
#pragma once

#include <algorithm>
#include <array>

#include "render/page/film_words_table.hpp"

namespace grainreel {

inline constexpr auto bed_rows = std::to_array<PageRow>({
    // The bed in three dimensions.
    {"The bed in three dimensions",
     {"Die Schüttung in drei Dimensionen", "Le lit en trois dimensions", "El lecho en tres dimensiones"}},
    {"The bed in three dimensions, which arrow keys turn",
     {"Die Schüttung in drei Dimensionen, mit Pfeiltasten zu drehen",
      "Le lit en trois dimensions, que tournent les touches fléchées",
      "El lecho en tres dimensiones, que giran las flechas"}},
    {"Drag to turn it, Shift and drag to move it, pinch to zoom; after a click the wheel and the keys + − ← "
     "→ ↑ ↓ work "
     "too. Click a grain to ask about it.",
     {"Ziehen dreht sie, Umschalt und Ziehen verschiebt sie, mit zwei Fingern vergrößern; nach einem Klick "
      "gehen auch "
      "Mausrad und die Tasten + − ← → ↑ ↓. Ein Klick auf ein Korn fragt nach ihm.",
      "Glisser pour le tourner, Maj et glisser pour le déplacer, pincer pour agrandir ; après un clic, la "
      "molette et les "
      "touches + − ← → ↑ ↓ marchent aussi. Cliquer sur un grain pour l’interroger.",
      "Arrastrar para girarlo, Mayús y arrastrar para moverlo, pellizcar para ampliar; tras un clic también "
      "valen la "
      "rueda y las teclas + − ← → ↑ ↓. Un clic en un grano pregunta por él."}},
    {"The bed is being unpacked.",
     {"Die Schüttung wird entpackt.", "Le lit est en train d’être décompressé.",
      "El lecho se está descomprimiendo."}},
    {"The bed in three dimensions is not shown: {1}. Film and charts do without it.",
     {"Die Schüttung wird nicht gezeigt: {1}. Film und Kurven gehen ohne sie.",
      "Le lit n’est pas montré : {1}. Film et courbes s’en passent.",
      "El lecho no se muestra: {1}. Película y curvas funcionan sin él."}},
    {"Places are rounded to 16 bits over the box that the grains reach: they are off by {1} µm along x, {2} "
     "µm "
     "along y and {3} µm along z at most. Speeds are right to 2.3 % and come from the run, not from "
     "differences of "
     "places. Nothing is interpolated between moments.",
     {"Orte sind auf 16 Bit gerundet, über den Quader, den die Körner erreichen: Sie sind höchstens um {1} "
      "µm in x, "
      "{2} µm in y und {3} µm in z falsch. Geschwindigkeiten stimmen auf 2.3 % und stammen aus dem Lauf, "
      "nicht aus "
      "Differenzen der Orte. Zwischen den Momenten ist nichts interpoliert.",
      "Les positions sont arrondies à 16 bits sur la boîte que les grains atteignent : l’erreur est d’au "
      "plus {1} µm "
      "en x, {2} µm en y et {3} µm en z. Les vitesses sont justes à 2.3 % près et viennent du calcul, non de "
      "différences de positions. Rien n’est interpolé entre les instants.",
      "Las posiciones están redondeadas a 16 bits en la caja que alcanzan los granos: el error es como "
      "máximo de {1} "
      "µm en x, {2} µm en y y {3} µm en z. Las velocidades son exactas al 2.3 % y vienen de la simulación, "
      "no de "
      "diferencias de posiciones. Nada se interpola entre los instantes."}},
    {"This is the only moment that the run kept.",
     {"Das ist der einzige Moment, den der Lauf aufbewahrt hat.",
      "C’est le seul instant que le calcul a gardé.", "Es el único instante que guardó la simulación."}},
    {"These are all {1} moments that the run kept.",
     {"Das sind alle {1} Momente, die der Lauf aufbewahrt hat.",
      "Ce sont tous les {1} instants que le calcul a gardés.",
      "Son todos los {1} instantes que guardó la simulación."}},
    {"Of the {1} moments that the run kept these are {2}, evenly spread; the page has no room for the "
     "others.",
     {"Von den {1} Momenten, die der Lauf aufbewahrt hat, sind das {2}, gleichmäßig verteilt; für die "
      "anderen hat "
      "die Seite keinen Platz.",
      "Des {1} instants que le calcul a gardés, en voici {2}, répartis régulièrement ; la page n’a pas de "
      "place pour "
      "les autres.",
      "De los {1} instantes que guardó la simulación estos son {2}, repartidos por igual; la página no tiene "
      "sitio "
      "para los demás."}},
    {"Of {1} grains it shows the {2} that lay nearest to the middle of the depth when they were first seen.",
     {"Von {1} Körnern zeigt sie die {2}, die am Anfang der Mitte der Tiefe am nächsten lagen.",
      "Des {1} grains on voit les {2} qui étaient d’abord le plus près du milieu de la profondeur.",
      "De {1} granos muestra los {2} que al principio estaban más cerca del medio de la profundidad."}},
    {"The run kept no contact numbers.",
     {"Zahlen der Kontakte hat der Lauf nicht aufbewahrt.", "Le calcul n’a pas gardé de nombres de contacts.",
      "La simulación no guardó números de contactos."}},
    {"Contact numbers are known at {1} of them.",
     {"Zahlen der Kontakte sind an {1} davon bekannt.",
      "Les nombres de contacts sont connus à {1} d’entre eux.",
      "Los números de contactos se conocen en {1} de ellos."}},
    {"What the film's colours stand for is known at {1} of them.",
     {"Wofür die Farben des Films stehen, ist an {1} davon bekannt.",
      "Ce que montrent les couleurs du film est connu à {1} d’entre eux.",
      "Lo que muestran los colores de la película se conoce en {1} de ellos."}},
    {"At {1} of them the page has the pairs that push each other, with their normal forces to 2.3 %.",
     {"An {1} davon hat die Seite die Paare, die einander drücken, mit ihren Normalkräften auf 2.3 %.",
      "À {1} d’entre eux la page a les paires qui se poussent, avec leurs forces normales à 2.3 % près.",
      "En {1} de ellos la página tiene los pares que se empujan, con sus fuerzas normales al 2.3 %."}},
    {"Grains that are glued to walls are not shown.",
     {"Körner, die an Wänden kleben, sind nicht gezeigt.",
      "Les grains collés aux parois ne sont pas montrés.",
      "Los granos pegados a las paredes no se muestran."}},
    {"The newest moment that the run has written. Places are rounded to 16 bits over the box that the grains "
     "reach.",
     {"Der neueste Moment, den der Lauf geschrieben hat. Orte sind auf 16 Bit gerundet, über den Quader, den "
      "die "
      "Körner erreichen.",
      "L’instant le plus récent que le calcul a écrit. Les positions sont arrondies à 16 bits sur la boîte "
      "que les "
      "grains atteignent.",
      "El instante más reciente que escribió la simulación. Las posiciones están redondeadas a 16 bits en la "
      "caja que "
      "alcanzan los granos."}},
    {"How fast the grains flow out",
     {"Wie schnell die Körner ausfließen", "À quelle vitesse les grains s’écoulent",
      "Con qué rapidez salen los granos"}},
    {"run", {"Lauf", "calcul", "simulación"}},
    {"measured, {1}", {"gemessen, {1}", "mesuré, {1}", "medido, {1}"}},
    {"Beverloo’s law, {1}", {"Gesetz von Beverloo, {1}", "loi de Beverloo, {1}", "ley de Beverloo, {1}"}},
    {"measured / law", {"gemessen / Gesetz", "mesuré / loi", "medido / ley"}},
    {"empty at, s", {"leer bei, s", "vide à, s", "vacío a los, s"}},
    {"The rate between the moments at which 10 % and 70 % of all that flows out were out, with its interval "
     "of 95 %. "
     "Beverloo’s law knows the outlet and the grains alone; friction and slanted walls change the rate by 20 "
     "% and "
     "more.",
     {"Die Rate zwischen den Momenten, an denen 10 % und 70 % von allem draußen waren, was ausfließt, mit "
      "ihrem "
      "Intervall von 95 %. Das Gesetz von Beverloo kennt nur die Öffnung und die Körner; Reibung und schräge "
      "Wände "
      "ändern die Rate um 20 % und mehr.",
      "Le débit entre les instants où 10 % et 70 % de tout ce qui s’écoule étaient sortis, avec son "
      "intervalle de 95 "
      "%. La loi de Beverloo ne connaît que l’orifice et les grains ; le frottement et les parois inclinées "
      "changent "
      "le débit de 20 % et plus.",
      "El caudal entre los instantes en que había salido el 10 % y el 70 % de todo lo que sale, con su "
      "intervalo del "
      "95 %. La ley de Beverloo solo conoce la abertura y los granos; el rozamiento y las paredes inclinadas "
      "cambian "
      "el caudal un 20 % y más."}},
    {"Colour by", {"Farbe nach", "Couleur selon", "Color según"}},
    {"species", {"Sorte", "espèce", "especie"}},
    {"speed (logarithmic)",
     {"Geschwindigkeit (logarithmisch)", "vitesse (logarithmique)", "rapidez (logarítmica)"}},
    {"height at start", {"Höhe am Anfang", "hauteur au départ", "altura inicial"}},
    {"rise since the moment before",
     {"Anstieg seit dem Moment davor", "montée depuis l’instant d’avant",
      "subida desde el instante anterior"}},
    {"contact number", {"Zahl der Kontakte", "nombre de contacts", "número de contactos"}},
    {"force (logarithmic)", {"Kraft (logarithmisch)", "force (logarithmique)", "fuerza (logarítmica)"}},
    {"as in the film: {1}", {"wie im Film: {1}", "comme dans le film : {1}", "como en la película: {1}"}},
    {"as in the film: {1}, logarithmic",
     {"wie im Film: {1}, logarithmisch", "comme dans le film : {1}, logarithmique",
      "como en la película: {1}, logarítmica"}},
    {"shown", {"sichtbar", "visible", "visible"}},
    {"ghost", {"durchscheinend", "translucide", "translúcido"}},
    {"hidden", {"verborgen", "caché", "oculto"}},
    {"Slice", {"Schnitt", "Coupe", "Corte"}},
    {"none", {"keiner", "aucun", "ninguno"}},
    {"front to back", {"von vorn nach hinten", "d’avant en arrière", "de delante hacia atrás"}},
    {"right to left", {"von rechts nach links", "de droite à gauche", "de derecha a izquierda"}},
    {"top to bottom", {"von oben nach unten", "de haut en bas", "de arriba abajo"}},
    {"Where the slice is", {"Ort des Schnitts", "Lieu de la coupe", "Lugar del corte"}},
    {"Reset the view", {"Blick zurücksetzen", "Vue de départ", "Vista inicial"}},
    {"Grain", {"Korn", "Grain", "Grano"}},
    {"Choose", {"Wählen", "Choisir", "Elegir"}},
    {"follow it", {"ihm folgen", "le suivre", "seguirlo"}},
    {"force chains", {"Kraftketten", "chaînes de force", "cadenas de fuerza"}},
    {"◀ forces", {"◀ Kräfte", "◀ forces", "◀ fuerzas"}},
    {"forces ▶", {"Kräfte ▶", "forces ▶", "fuerzas ▶"}},
    {"To the moment with forces before this one",
     {"Zum vorigen Moment mit Kräften", "À l’instant précédent avec forces",
      "Al instante anterior con fuerzas"}},
    {"To the next moment with forces",
     {"Zum nächsten Moment mit Kräften", "À l’instant suivant avec forces",
      "Al instante siguiente con fuerzas"}},
    {"The newest moment, {1} s of the run.",
     {"Der neueste Moment, {1} s des Laufs.", "L’instant le plus récent, {1} s du calcul.",
      "El instante más reciente, {1} s de la simulación."}},
    {"Moment {1} of {2}, {3} s of the run.",
     {"Moment {1} von {2}, {3} s des Laufs.", "Instant {1} sur {2}, {3} s du calcul.",
      "Instante {1} de {2}, {3} s de la simulación."}},
    {"Moment {1} of {2}, {3} s of the run, the nearest that was kept to {4} s.",
     {"Moment {1} von {2}, {3} s des Laufs, der nächste behaltene zu {4} s.",
      "Instant {1} sur {2}, {3} s du calcul, le plus proche conservé de {4} s.",
      "Instante {1} de {2}, {3} s de la simulación, el conservado más cercano a {4} s."}},
    {"Forces between grains are known at {1} moments of the page, the nearest at {2} s. At this one they are "
     "not.",
     {"Kräfte zwischen Körnern sind an {1} Momenten der Seite bekannt, am nächsten bei {2} s. Hier sind sie "
      "es nicht.",
      "Les forces entre grains sont connues à {1} instants de la page, le plus proche à {2} s. Ici, non.",
      "Las fuerzas entre granos se conocen en {1} instantes de la página, el más cercano a {2} s. Aquí no."}},
    {"Bands join grains that push each other. The widest stand for {1} N and more.",
     {"Bänder verbinden Körner, die einander drücken. Die breitesten stehen für {1} N und mehr.",
      "Des bandes relient les grains qui se poussent. Les plus larges valent {1} N et plus.",
      "Las bandas unen granos que se empujan. Las más anchas valen {1} N o más."}},
    {"The forces of this moment are known.",
     {"Die Kräfte dieses Moments sind bekannt.", "Les forces de cet instant sont connues.",
      "Las fuerzas de este instante se conocen."}},
    {"No grain is chosen: click one, or give its id.",
     {"Kein Korn ist gewählt: eins anklicken oder seine Nummer angeben.",
      "Aucun grain n’est choisi : en cliquer un ou donner son numéro.",
      "No hay grano elegido: pulsar uno o dar su número."}},
    {"Grain {1}, {2}", {"Korn {1}, {2}", "Grain {1}, {2}", "Grano {1}, {2}"}},
    {"{1}: not in the container at this moment.",
     {"{1}: in diesem Moment nicht im Behälter.", "{1} : pas dans le récipient à cet instant.",
      "{1}: no está en el recipiente en este instante."}},
    {"diameter {1} mm", {"Durchmesser {1} mm", "diamètre {1} mm", "diámetro {1} mm"}},
    {"at ({1}) mm", {"bei ({1}) mm", "à ({1}) mm", "en ({1}) mm"}},
    {"its speed is not known",
     {"seine Geschwindigkeit ist unbekannt", "sa vitesse est inconnue", "su rapidez no se conoce"}},
    {"speed {1} m/s", {"Geschwindigkeit {1} m/s", "vitesse {1} m/s", "rapidez {1} m/s"}},
    {"speed below {1} m/s",
     {"Geschwindigkeit unter {1} m/s", "vitesse sous {1} m/s", "rapidez menor de {1} m/s"}},
    {"{1} contacts", {"{1} Kontakte", "{1} contacts", "{1} contactos"}},
    {"way so far at least {1} mm",
     {"Weg bisher mindestens {1} mm", "chemin parcouru au moins {1} mm",
      "camino hasta ahora al menos {1} mm"}},
    {"Near neighbours: {1}.", {"Nahe Nachbarn: {1}.", "Proches voisins : {1}.", "Vecinos cercanos: {1}."}},
    {"Pushed by: {1}.", {"Gedrückt von: {1}.", "Poussé par : {1}.", "Empujado por: {1}."}},
    {"{1} and others", {"{1} und andere", "{1} et d’autres", "{1} y otros"}},
    {"{1} with {2} N", {"{1} mit {2} N", "{1} avec {2} N", "{1} con {2} N"}},
    {"nobody", {"niemand", "personne", "nadie"}},
    {"a wall", {"einer Wand", "une paroi", "una pared"}},
    // Fields.
    {"Fields and profiles", {"Felder und Profile", "Champs et profils", "Campos y perfiles"}},
    {"Show", {"Zeige", "Montrer", "Mostrar"}},
    {"Profile", {"Profil", "Profil", "Perfil"}},
    {"over height", {"über der Höhe", "selon la hauteur", "según la altura"}},
    {"Map of the field", {"Karte des Feldes", "Carte du champ", "Mapa del campo"}},
    {"Profile of the field", {"Profil des Feldes", "Profil du champ", "Perfil del campo"}},
    {"Map: {1}", {"Karte: {1}", "Carte : {1}", "Mapa: {1}"}},
    {"Profile: {1} At the bottom {2}, at the top {3}.",
     {"Profil: {1} Unten {2}, oben {3}.", "Profil : {1} En bas {2}, en haut {3}.",
      "Perfil: {1} Abajo {2}, arriba {3}."}},
    {"{1}, mean from {2} to {3} s of the run.",
     {"{1}, Mittel von {2} bis {3} s des Laufs.", "{1}, moyenne de {2} à {3} s du calcul.",
      "{1}, media de {2} a {3} s de la simulación."}},
    {"The fields are not shown: {1}.",
     {"Die Felder werden nicht gezeigt: {1}.", "Les champs ne sont pas montrés : {1}.",
      "Los campos no se muestran: {1}."}},
    // Several runs.
    {"{1} runs side by side, at the same time of each run.",
     {"{1} Läufe nebeneinander, zur selben Zeit jedes Laufs.",
      "{1} calculs côte à côte, au même temps de chacun.",
      "{1} simulaciones lado a lado, en el mismo tiempo de cada una."}},
    {"The film of all of them", {"Der Film von allen", "Le film de tous", "La película de todas"}},
    {"{1}: in words", {"{1}: in Worten", "{1} : en mots", "{1}: en palabras"}},
    {"Folder {1}", {"Ordner {1}", "Dossier {1}", "Carpeta {1}"}},
    {"What differs", {"Was verschieden ist", "Ce qui diffère", "Qué difiere"}},
    {"The scenes are the same.",
     {"Die Szenen sind gleich.", "Les scènes sont les mêmes.", "Las escenas son iguales."}},
    {"Plain numbers are in SI units, phases in turns, the camera's angles in degrees.",
     {"Bloße Zahlen sind in SI-Einheiten, Phasen in Umdrehungen, Winkel der Kamera in Grad.",
      "Les nombres seuls sont en unités SI, les phases en tours, les angles de la caméra en degrés.",
      "Los números solos están en unidades SI, las fases en vueltas, los ángulos de la cámara en grados."}},
    {"Keys that differ", {"Schlüssel, die verschieden sind", "Clés qui diffèrent", "Claves que difieren"}},
    {"key", {"Schlüssel", "clé", "clave"}},
    // The first sentence.
    {"{1} and {2}", {"{1} und {2}", "{1} et {2}", "{1} y {2}"}},
    {"{1} {2} that are fed",
     {"{1} {2}, die zugeführt werden", "{1} {2} alimentés", "{1} {2} que se alimentan"}},
    {"{1} {2} (and {3} more that are fed)",
     {"{1} {2} (und {3} weitere, die zugeführt werden)", "{1} {2} (et {3} autres, alimentés)",
      "{1} {2} (y {3} más que se alimentan)"}},
    {"in a wedge hopper", {"in einem Keiltrichter", "dans une trémie en coin", "en una tolva en cuña"}},
    {"in a box", {"in einem Kasten", "dans une boîte", "en una caja"}},
    {"in a cylinder", {"in einem Zylinder", "dans un cylindre", "en un cilindro"}},
    {"in a vessel", {"in einem Gefäß", "dans un récipient", "en un recipiente"}},
    {"in empty space", {"im leeren Raum", "dans l’espace vide", "en el espacio vacío"}},
    {"in the vessel “{1}”", {"im Gefäß „{1}“", "dans le récipient « {1} »", "en el recipiente «{1}»"}},
    {"{1} with {2}", {"{1} mit {2}", "{1} avec {2}", "{1} con {2}"}},
    {"with walls of any shape, {1}",
     {"mit Wänden beliebiger Form, {1}", "avec des parois de forme libre, {1}",
      "con paredes de cualquier forma, {1}"}},
    {"{1} meshes", {"{1} Netzen", "{1} maillages", "{1} mallas"}},
    {"without a drive, for {1} s",
     {"ohne Antrieb, {1} s lang", "sans excitation, pendant {1} s", "sin excitación, durante {1} s"}},
    {"shaken at {1} Hz (amplitude {2} mm) for {3} s",
     {"{3} s lang mit {1} Hz geschüttelt (Amplitude {2} mm)",
      "secoués à {1} Hz (amplitude {2} mm) pendant {3} s",
      "agitados a {1} Hz (amplitud {2} mm) durante {3} s"}},
    {"shaken at {1} Hz with Γ = {4} (amplitude {2} mm) for {3} s",
     {"{3} s lang mit {1} Hz und Γ = {4} geschüttelt (Amplitude {2} mm)",
      "secoués à {1} Hz avec Γ = {4} (amplitude {2} mm) pendant {3} s",
      "agitados a {1} Hz con Γ = {4} (amplitud {2} mm) durante {3} s"}},
    {"{1} and then otherwise", {"{1}, danach anders", "{1}, puis autrement", "{1} y después de otro modo"}},
    // The chapters.
    {"What was computed", {"Was gerechnet wurde", "Ce qui a été calculé", "Qué se calculó"}},
    {"Contacts", {"Kontakte", "Contacts", "Contactos"}},
    {"To cite", {"Zum Zitieren", "Pour citer", "Para citar"}},
    {"Methods", {"Methoden", "Méthodes", "Métodos"}},
    {"Where it comes from", {"Woher es kommt", "D’où cela vient", "De dónde viene"}},
    {"Warnings of the run", {"Warnungen des Laufs", "Avertissements du calcul", "Avisos de la simulación"}},
    {"Scene", {"Szene", "Scène", "Escena"}},
    {"Files of the run", {"Dateien des Laufs", "Fichiers du calcul", "Archivos de la simulación"}},
    // A run that goes on.
    {"How far the run is", {"Wie weit der Lauf ist", "Où en est le calcul", "Cómo va la simulación"}},
    {"The run is being looked at.",
     {"Der Lauf wird angesehen.", "Le calcul est examiné.", "Se está mirando la simulación."}},
    {"The run’s own page has all of its moments and its film.",
     {"Die Seite des Laufs hat alle Momente und den Film.",
      "La page du calcul a tous ses instants et son film.",
      "La página de la simulación tiene todos sus instantes y su película."}},
    {"The run has written no grains yet.",
     {"Der Lauf hat noch keine Körner geschrieben.", "Le calcul n’a pas encore écrit de grains.",
      "La simulación aún no ha escrito granos."}},
    {"The film has no picture yet.",
     {"Der Film hat noch kein Bild.", "Le film n’a pas encore d’image.", "La película aún no tiene imagen."}},
    {"The run has measured nothing yet.",
     {"Der Lauf hat noch nichts gemessen.", "Le calcul n’a encore rien mesuré.",
      "La simulación aún no ha medido nada."}},
    {"The grains are being packed.",
     {"Die Körner werden gepackt.", "Les grains sont mis en place.", "Los granos se están empaquetando."}},
    {"{1} of {2} s", {"{1} von {2} s", "{1} sur {2} s", "{1} de {2} s"}},
    {", {1} left", {", noch {1}", ", encore {1}", ", faltan {1}"}},
    {"The run is complete: {1} s.",
     {"Der Lauf ist fertig: {1} s.", "Le calcul est terminé : {1} s.",
      "La simulación está completa: {1} s."}},
    {"The run was stopped at {1}.",
     {"Der Lauf wurde bei {1} angehalten.", "Le calcul a été arrêté à {1}.",
      "La simulación se detuvo en {1}."}},
    {"The run failed at {1}; log.txt tells why.",
     {"Der Lauf ist bei {1} gescheitert; log.txt sagt, warum.",
      "Le calcul a échoué à {1} ; log.txt dit pourquoi.",
      "La simulación falló en {1}; log.txt dice por qué."}},
    {"The run’s folder has gone.",
     {"Der Ordner des Laufs ist fort.", "Le dossier du calcul a disparu.",
      "La carpeta de la simulación ya no está."}},
    {"The run was broken off at {1}.",
     {"Der Lauf brach bei {1} ab.", "Le calcul s’est interrompu à {1}.",
      "La simulación se interrumpió en {1}."}},
    {"The film’s newest picture.",
     {"Das neueste Bild des Films.", "L’image la plus récente du film.",
      "La imagen más reciente de la película."}},
    {"The program that shows the run has ended; what it showed last is below.",
     {"Das Programm, das den Lauf zeigt, ist beendet; unten steht, was es zuletzt zeigte.",
      "Le programme qui montre le calcul s’est arrêté ; ce qu’il a montré en dernier est ci-dessous.",
      "El programa que muestra la simulación ha terminado; abajo está lo último que mostró."}},
    // Notes about the film.
    {"The film is not on this page, since {1} is not in the run's folder.",
     {"Der Film steht nicht auf dieser Seite, denn {1} fehlt im Ordner des Laufs.",
      "Le film n’est pas sur cette page, car {1} n’est pas dans le dossier du calcul.",
      "La película no está en esta página, porque {1} no está en la carpeta de la simulación."}},
    {"The film is not on this page, since {1} is damaged ({2}).",
     {"Der Film steht nicht auf dieser Seite, denn {1} ist beschädigt ({2}).",
      "Le film n’est pas sur cette page, car {1} est endommagé ({2}).",
      "La película no está en esta página, porque {1} está dañado ({2})."}},
    {"browsers do not play {1}",
     {"Browser spielen {1} nicht", "les navigateurs ne lisent pas {1}", "los navegadores no reproducen {1}"}},
    {"the film has {1}", {"der Film hat {1}", "le film fait {1}", "la película tiene {1}"}},
    {"This is a copy of at most 720 lines, since {1}; the film itself is {2} in the run's folder.",
     {"Dies ist eine Kopie mit höchstens 720 Zeilen ({1}); der Film selbst ist {2} im Ordner des Laufs.",
      "Ceci est une copie de 720 lignes au plus ({1}) ; le film lui-même est {2} dans le dossier du calcul.",
      "Esto es una copia de 720 líneas como máximo ({1}); la película misma es {2} en la carpeta de la "
      "simulación."}},
    {"The film is not on this page, since {1}, and no copy could be made ({2}); it is {3} in the run's "
     "folder.",
     {"Der Film steht nicht auf dieser Seite ({1}), und eine Kopie gelang nicht ({2}); er ist {3} im Ordner "
      "des Laufs.",
      "Le film n’est pas sur cette page ({1}), et aucune copie n’a pu être faite ({2}) ; il est {3} dans le "
      "dossier du calcul.",
      "La película no está en esta página ({1}), y no se pudo hacer una copia ({2}); es {3} en la carpeta de "
      "la simulación."}},
    {"The film is not on this page, since {1} and even a smaller copy is too large for it; it is {2} in the "
     "run's folder.",
     {"Der Film steht nicht auf dieser Seite ({1}), und auch eine kleinere Kopie wäre zu groß; er ist {2} im "
      "Ordner des Laufs.",
      "Le film n’est pas sur cette page ({1}), et même une copie plus petite est trop grande ; il est {2} "
      "dans le dossier du calcul.",
      "La película no está en esta página ({1}), y hasta una copia más pequeña es demasiado grande; es {2} "
      "en la carpeta de la simulación."}},
    {"This version of the program would not run the scene, so it cannot tell which moments the film shows.",
     {"Diese Version des Programms würde die Szene nicht rechnen, deshalb weiß sie nicht, welche Augenblicke "
      "der Film zeigt.",
      "Cette version du programme ne calculerait pas la scène ; elle ne sait donc pas quels instants le film "
      "montre.",
      "Esta versión del programa no ejecutaría la escena, así que no sabe qué momentos muestra la "
      "película."}},
    {"The film leaves out moments, and the run does not say which, so the film goes by itself. With "
     "film.periods in the scene it would be tied to charts and bed.",
     {"Der Film lässt Augenblicke aus, und der Lauf sagt nicht welche, deshalb läuft der Film für sich. Mit "
      "film.periods in der Szene wäre er mit Kurven und Schüttung verbunden.",
      "Le film saute des instants, et le calcul ne dit pas lesquels ; le film défile donc seul. Avec "
      "film.periods dans la scène, il serait lié aux courbes et au lit de grains.",
      "La película omite momentos, y la simulación no dice cuáles, así que va por su cuenta. Con "
      "film.periods en la escena estaría ligada a las curvas y al lecho."}},
    {"Which moments the film shows is not known, so it goes by itself.",
     {"Welche Augenblicke der Film zeigt, ist nicht bekannt, deshalb läuft er für sich.",
      "On ne sait pas quels instants le film montre ; il défile donc seul.",
      "No se sabe qué momentos muestra la película, así que va por su cuenta."}},
});

inline constexpr auto page_rows = [] {
    std::array<PageRow, film_rows.size() + bed_rows.size()> all{};
    std::copy(bed_rows.begin(), bed_rows.end(), std::copy(film_rows.begin(), film_rows.end(), all.begin()));
    return all;
}();

}  // namespace grainreel

// Reads what the page carries inside itself: facts as JSON, and blobs as base64 in its last elements.

/** The JSON of the element `id`; null without one. */
function factsOf(id) {
    const element = document.getElementById(id);
    return element ? JSON.parse(element.textContent) : null;
}

const words = factsOf("facts")?.words ?? {}; // the page's words that are not English, by their English text

/** The words for an English text, with parts in place of {1}, {2} ... (render/page/page_words_table.hpp) */
function tr(english, ...parts) {
    return (words[english] ?? english).replace(/\{([1-9])\}/g, (whole, number) => String(parts[number - 1] ?? whole));
}

/** The bytes of the blob `id`; null without one. */
function bytesOf(id) {
    const element = document.getElementById(id);
    if (!element) return null;
    const text = element.textContent.trim();
    element.remove();
    return Uint8Array.fromBase64 ? Uint8Array.fromBase64(text) : bytesOfBase64(text);
}

// For browsers from before 2025, which lack Uint8Array.fromBase64.
function bytesOfBase64(text) {
    const unpacked = atob(text), bytes = new Uint8Array(unpacked.length);
    for (let i = 0; i < unpacked.length; ++i) bytes[i] = unpacked.charCodeAt(i);
    return bytes;
}

/** A promise of the unpacked bytes. It fails when the browser cannot unpack them or they are damaged. */
async function inflated(bytes) {
    if (typeof DecompressionStream === "undefined")
        throw new Error("this browser cannot unpack them (no DecompressionStream)");
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A number as text: four digits, with a power of ten only when it is needed. */
function numberText(value) {
    if (value === null || !Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    if (value !== 0 && (size < 1e-3 || size >= 1e5)) {
        const [digits, power] = value.toExponential(3).split("e");
        return withMinus(`${Number(digits)}·10${[...String(Number(power))].map((sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]).join("")}`);
    }
    return withMinus(String(Number(value.toPrecision(4))));
}

/** A number with a true minus in place of a hyphen. */
function withMinus(text) {
    return text.replace("-", "−");
}

/** The index of the entry nearest to `time`. The entries of `times` must rise. */
function nearestIndex(times, time) {
    let low = 0, high = times.length - 1;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] < time) low = middle + 1;
        else high = middle;
    }
    return low > 0 && time - times[low - 1] < times[low] - time ? low - 1 : low;
}

/** An element with properties, styles in `style` and children. Text never becomes markup. */
function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key.startsWith("aria-") || key === "role" || key === "for") made.setAttribute(key, value);
        else made[key] = value;
    }
    made.append(...children);
    return made;
}

"""Chromium without a screen, driven through Selenium, and what tests ask of it."""
import base64
import os
import pathlib
import time

from selenium import webdriver
from selenium.common.exceptions import TimeoutException
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

KEPT = pathlib.Path(__file__).parent / "kept"
MOST_MEAN, MOST_BLOCKS = 6, 0.03  # by which pictures of the same page may differ, see Browser.difference
SECONDS_UNTIL_PAINTED = 20  # a frame of a film, on a busy machine
SECONDS_UNTIL_READY = 180  # software graphics on a busy machine, where 60 s were too few once; a page that hangs fails


class Browser:
    """One window. options: further words of the command line; at_start: a script that runs before the page's own."""

    def __init__(self, width=1280, height=1000, options=(), at_start=None, dark=False):
        settings = Options()
        for word in ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--hide-scrollbars", "--force-device-scale-factor=1", *options]:
            settings.add_argument(word)
        settings.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=settings)
        self.driver.set_script_timeout(SECONDS_UNTIL_READY)
        self.resize(width, height)
        if at_start:
            self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": at_start})
        if dark:
            self.driver.execute_cdp_cmd(
                "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def resize(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})

    def open(self, page: pathlib.Path):
        self.driver.get(page.resolve().as_uri())
        self.wait("return document.documentElement.dataset.ready === 'yes'", "the page to be ready")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, what):
        """Until the script returns true."""
        end = time.monotonic() + SECONDS_UNTIL_READY
        while not self.run(script):
            if time.monotonic() > end:
                raise AssertionError(f"waited in vain for {what}")
            time.sleep(0.05)

    def console(self):
        """What was written to the console since the last call."""
        return [f"{entry['level']}: {entry['message']}" for entry in self.driver.get_log("browser")]

    def pointer(self, kind, x, y, buttons=1):
        """A mouse event at a place of the window, CSS pixels: mousePressed, mouseMoved, mouseReleased."""
        self.driver.execute_cdp_cmd("Input.dispatchMouseEvent",
                                    {"type": kind, "x": x, "y": y, "buttons": buttons, "button": "left",
                                     "clickCount": 1})

    def view(self):
        """A WebP of what the window shows."""
        shot = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "webp", "quality": 80})
        return base64.b64decode(shot["data"])

    def difference(self, one: bytes, other: bytes):
        """Of two pictures: the mean of their blocks' differences, of 255, and the share of blocks that differ much.
        Blocks have 8 x 8 pixels, so that the edges of letters count little."""
        texts = [base64.b64encode(picture).decode() for picture in (one, other)]
        return self.driver.execute_async_script("""
            const [texts, done] = arguments, block = 8, much = 40;
            const read = async (text) => {
                const image = new Image();
                image.src = 'data:image/webp;base64,' + text;
                await image.decode();
                const canvas = document.createElement('canvas');
                canvas.width = Math.floor(image.width / block);
                canvas.height = Math.floor(image.height / block);
                const context = canvas.getContext('2d');
                context.imageSmoothingQuality = 'high';
                context.drawImage(image, 0, 0, canvas.width, canvas.height);
                return context.getImageData(0, 0, canvas.width, canvas.height);
            };
            Promise.all(texts.map(read)).then(([a, b]) => {
                if (a.width !== b.width || a.height !== b.height) return done([255, 1]);
                let sum = 0, many = 0;
                for (let at = 0; at < a.data.length; at += 4) {
                    const apart = Math.max(...[0, 1, 2].map((part) => Math.abs(a.data[at + part] - b.data[at + part])));
                    sum += apart;
                    if (apart > much) ++many;
                }
                done([sum / (a.data.length / 4), many / (a.data.length / 4)]);
            });""", texts)

    def least_difference(self, kept: bytes, seen: pathlib.Path):
        """Of what the window shows from the kept picture. A busy browser paints a film's frame some time after the film says
        that it has found it, so the window is looked at until it is as kept. seen: where the last look is written."""
        end = time.monotonic() + SECONDS_UNTIL_PAINTED
        while True:
            now = self.view()
            seen.write_bytes(now)
            mean, blocks = self.difference(kept, now)
            if (mean <= MOST_MEAN and blocks <= MOST_BLOCKS) or time.monotonic() > end:
                return mean, blocks
            time.sleep(0.5)

    def looks_as_kept(self, name, folder, settled="return true", middle=None):
        """What the window shows, wide and narrow, against the pictures in kept/, which GRAINREEL_KEEP=1 makes anew. Fonts and
        the film's buttons differ a little from machine to machine. settled: what to wait for. folder: for what is seen.
        middle: of the window, a selector; without it the page's beginning is looked at."""
        for width in (1280, 390):
            self.resize(width, 1000)
            self.run("document.activeElement.blur(); scrollTo({top: 0, behavior: 'instant'})")
            if middle:
                self.place_of(middle)
            self.wait(settled, "the page to settle")
            self.driver.execute_async_script("const done = arguments[0]; setTimeout(() => requestAnimationFrame(() =>"
                                             "requestAnimationFrame(() => done())), 500)")
            kept = KEPT / f"{name}_{width}.webp"
            if os.environ.get("GRAINREEL_KEEP"):
                kept.write_bytes(self.view())
            mean, blocks = self.least_difference(kept.read_bytes(), folder / f"view_{name}_{width}.webp")
            assert mean <= MOST_MEAN and blocks <= MOST_BLOCKS, (name, width, mean, blocks)
            print(f"  {width} pixels wide: blocks differ by {mean:.2f} of 255, {100 * blocks:.2f} % of them much")
        self.resize(1280, 1000)

    def place_of(self, selector):
        """left, top, width, height of the first such element in the window, scrolled to its middle."""
        return self.run(
            "const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center', behavior: 'instant'});"
            "const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height];", selector)

    def picture(self, file: pathlib.Path, most_height=8000):
        """Of the whole page."""
        width = self.run("return innerWidth")
        height = min(most_height, self.run("return document.documentElement.scrollHeight"))
        self.resize(width, height)
        time.sleep(0.5)
        for attempt in range(6):  # the driver waits 10 s for a picture, and a busy machine may need longer
            try:
                self.driver.save_screenshot(str(file))
                break
            except TimeoutException:
                if attempt == 5:
                    raise
        self.resize(width, 1000)

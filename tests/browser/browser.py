"""Chromium without a screen, driven through Selenium, and what tests ask of it."""
import pathlib
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

SECONDS_UNTIL_READY = 60  # software graphics on a busy machine; a page that hangs fails


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
        self.driver.save_screenshot(str(file))
        self.resize(width, 1000)

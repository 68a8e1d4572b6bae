#!/usr/bin/env python3
"""explain_test.py GAZED GAZELAB: the pages of gazelab explain in a real browser, Debian's Chromium, without a network.

Of a located, an uncertain and a lost fixation of the simulated robot: the browser reports no error, loads nothing from anywhere, shows
every picture, and its words are those of the answer that gazed published. Exit: 0 passed, 1 failed, 77 cannot be run here.
"""

import json
import pathlib
import shutil
import sys
import tempfile

import checks
from checks import require, skip

FAR = "repeat = true\n[[report_test]]\nnumber = 1\nrange_m = 2.0\n"  # before a bare wall nobody can tell how far that is
FLEEING = "repeat = true\n[[report_test]]\nnumber = 1\nrange_m = 0.30\nvelocity_m_s = [0.0, 0.5, 0.0]\n"  # gone before the head has turned
SCENES = {"LOCATED": "", "UNCERTAIN": FAR, "TARGET_LOST": FLEEING}
CHARTS = {"LOCATED": 2, "UNCERTAIN": 2, "TARGET_LOST": 0}


def run(*command):
    return checks.run(*command, timeout_s=300)


def record(gazed, scene, folder):
    """A recording of one fixation, and the point that gazed prints."""
    options = []
    if scene:
        (folder / "scene.toml").write_text(scene)
        options = ["--scene", folder / "scene.toml"]
    printed = run(gazed, "--fixations", 1, "--record", folder / "walk.lcm", "--print", "json", "--lcm-url", "memq://", *options)
    return json.loads(printed.splitlines()[0])


def open_browser(folder):
    try:
        from selenium import webdriver
    except ImportError:
        skip("build/python has no selenium; toolchain/test installs it")
    programs = [shutil.which(name) for name in ("chromium", "chromedriver")]
    if None in programs:
        skip("the Debian packages chromium and chromium-driver are not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = programs[0]
    for argument in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={folder}/profile", "--window-size=1320,1000"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.ChromeService(programs[1]))


def requested(browser, page):
    """Every address that the page asked for; the browser's own new tab asks for others."""
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    requests = [message["params"] for message in messages if message["method"] == "Network.requestWillBeSent"]
    return [request["request"]["url"] for request in requests if request["documentURL"] == page]


def check_page(browser, page, status, point):
    browser.get(page.as_uri())
    errors = browser.get_log("browser")
    require(not errors, f"{status}: the browser says {errors}")
    urls = requested(browser, page.as_uri())
    require(page.as_uri() in urls, f"{status}: the page itself is not among {urls}")
    foreign = [url for url in urls if not url.startswith("data:") and url != page.as_uri()]
    require(not foreign, f"{status}: the page asks for {foreign}")
    pictures = browser.execute_script("return [...document.images].map(i => [i.alt, i.complete, i.naturalWidth, i.getBoundingClientRect().width])")
    require(all(complete and width > 0 and shown > 100 for _, complete, width, shown in pictures), f"{status}: pictures {pictures}")
    looks = sum(alt.startswith("Look ") for alt, *_ in pictures)
    require(looks >= 4, f"{status}: {looks} pictures of looks; each of two looks and more has two")
    require(len(pictures) == looks + 1 + CHARTS[status], f"{status}: {len(pictures)} pictures, {looks} of them of looks")
    overflow = browser.execute_script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    require(overflow <= 0, f"{status}: the page is {overflow} px wider than the window")

    words = browser.execute_script("return document.body.innerText")
    require(status in words, f"{status} is not on its page: {words[:300]}")
    require(point["reason"] in words, f"{status}: the reason is missing: {point['reason']}")
    if point["range_m"] is not None:
        require(f"{point['range_m']:.3f} m away ± {point['range_sigma_m']:.3f} m" in words, f"{status}: {point['range_m']} m is not on its page")
        require("lever arm" in words and "Here they do not" in words, f"{status}: costs or epipoles are missing")


def main():
    gazed, gazelab = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        browser = open_browser(folder)
        try:
            for status, scene in SCENES.items():
                here = pathlib.Path(folder) / status
                here.mkdir()
                point = record(gazed, scene, here)
                require(point["status"] == status, f"the scene for {status} gave {point['status']}")
                run(gazelab, "explain", here / "walk.lcm", "--out", here)
                check_page(browser, here / "fixation-1.html", status, point)
        finally:
            browser.quit()
    print("passed")


if __name__ == "__main__":
    main()

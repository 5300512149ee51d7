"""What both comparisons share: running facet, reading pictures, printing tables, mounting contact sheets."""
import argparse
import base64
import concurrent.futures
import html
import io
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from PIL import Image, ImageDraw
except ImportError as error:
    print(f"skipped: python3-numpy and python3-pil are needed ({error})")
    raise SystemExit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIP = 77  # ctest's exit code for "skipped"


def corpus():
    """The corpus' folder: FACET_CORPUS, or beside the project."""
    return pathlib.Path(os.environ.get("FACET_CORPUS") or ROOT.parent / "shared" / "corpus")


def need(path):
    """Ends the program as skipped where `path` is absent."""
    if not path.exists():
        print(f"skipped: {path} is absent")
        raise SystemExit(SKIP)


def parser(description):
    p = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--facet", type=pathlib.Path, default=ROOT / "build" / "release" / "facet", metavar="PATH",
                   help="the program (default: %(default)s)")
    p.add_argument("--only", action="append", metavar="NAME", help="only what has NAME in its name; may be repeated")
    p.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="renders at a time")
    p.add_argument("--work", type=pathlib.Path, metavar="DIR", help="keep facet's pictures here (default: temporary)")
    p.add_argument("--reuse", action="store_true", help="compare the pictures in --work without rendering anew")
    p.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write all numbers")
    p.add_argument("--html", type=pathlib.Path, metavar="FILE", help="write a contact sheet with its pictures inside")
    p.add_argument("--montage", type=pathlib.Path, metavar="DIR", help="write a PNG of the pictures side by side")
    return p


def work_folder(options):
    """--work, or a temporary folder; keep the returned object alive while its name is used."""
    if options.work:
        options.work.mkdir(parents=True, exist_ok=True)
        return options.work, None
    temporary = tempfile.TemporaryDirectory(prefix="facet-compare-")
    return pathlib.Path(temporary.name), temporary


def selected(name, only):
    return not only or any(word.lower() in name.lower() for word in only)


def render(facet, arguments, picture, timeout=300):
    """Runs `facet render`; returns an error text, or None where `picture` was written."""
    picture.unlink(missing_ok=True)
    command = [str(facet), "render", *map(str, arguments), "-o", str(picture), "--quiet"]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return f"no picture after {timeout} s"
    if run.returncode != 0:
        said = (run.stderr or run.stdout).strip().splitlines()
        return f"exit {run.returncode}: {said[-1] if said else 'no message'}"
    return None if picture.exists() else "exit 0 without a picture"


def in_parallel(function, items, jobs):
    """[function(item) ...] in the items' order, `jobs` at a time."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(jobs, 1)) as pool:
        return list(pool.map(function, items))


def read_rgba(path):
    """Float RGBA in [0, 1], straight alpha; 1 where the file has none."""
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"), dtype=np.float32) / 255.0


def averaged(rgba, width, height):
    """The picture averaged down to width x height, in encoded values and weighted by alpha as picture tools do it."""
    premultiplied = np.concatenate([rgba[..., :3] * rgba[..., 3:], rgba[..., 3:]], axis=-1)
    mean = np.stack([np.asarray(Image.fromarray(np.ascontiguousarray(premultiplied[..., c])).resize(
        (width, height), Image.BOX)) for c in range(4)], axis=-1)
    colour = np.where(mean[..., 3:] > 0, mean[..., :3] / np.maximum(mean[..., 3:], 1e-6), 0)
    return np.concatenate([colour, mean[..., 3:]], axis=-1)


def over(rgba, background):
    """The picture over an sRGB colour or picture, blended in encoded values as viewers show it."""
    alpha = rgba[..., 3:]
    return rgba[..., :3] * alpha + np.asarray(background, dtype=np.float32) * (1 - alpha)


def mount(panels, height=320):
    """One picture of (caption, RGB array) panels side by side, scaled to one height."""
    images = []
    for caption, array in panels:
        image = Image.fromarray((np.clip(array, 0, 1) * 255 + 0.5).astype(np.uint8))
        width = max(round(image.width * height / image.height), 40)
        images.append((caption, image.resize((width, height), Image.LANCZOS)))
    sheet = Image.new("RGB", (sum(i.width + 4 for _, i in images), height + 14), "white")
    draw, x = ImageDraw.Draw(sheet), 0
    for caption, image in images:
        draw.text((x + 2, 1), caption, fill="black")
        sheet.paste(image, (x, 14))
        x += image.width + 4
    return sheet


class Sheets:
    """Collects mounted pictures into --montage and --html."""

    def __init__(self, options, title):
        self.folder, self.page, self.title, self.body = options.montage, options.html, title, []
        if self.folder:
            self.folder.mkdir(parents=True, exist_ok=True)

    def wanted(self):
        return bool(self.folder or self.page)

    def add(self, name, panels, text):
        sheet = mount(panels)
        if self.folder:
            sheet.save(self.folder / f"{name}.png")
        if self.page:
            data = io.BytesIO()
            sheet.save(data, "JPEG", quality=88)
            encoded = base64.b64encode(data.getvalue()).decode()
            self.body.append(f"<h3>{html.escape(name)}</h3><p>{html.escape(text)}</p>"
                             f'<img src="data:image/jpeg;base64,{encoded}">')

    def write(self):
        if self.page:
            self.page.write_text(f"<!doctype html><meta charset=utf-8><title>{self.title}</title>"
                                 f"<body style='font:14px sans-serif'><h1>{self.title}</h1>" + "\n".join(self.body),
                                 encoding="utf-8")


def number(value, form="{:.4f}"):
    """A number for a table; '-' for None and nan."""
    return "-" if value is None or value != value else form.format(value)


def print_table(header, rows):
    """Columns aligned: the first to the left, the others to the right."""
    table = [header] + [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in table) for i in range(len(header))]
    for i, row in enumerate(table):
        print("  ".join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]).rstrip())
        if i == 0:
            print("  ".join("-" * w for w in widths))
    sys.stdout.flush()

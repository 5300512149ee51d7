"""Scenes for the benches, made here and written as .glb: grids of triangles, layers, lights, and one scene with all
that a material, a mesh or a frame can ask for, less what is named. Needs numpy."""
import json
import struct
import zlib

import numpy as np

FLOAT, UINT32, UINT16, UINT8 = 5126, 5125, 5123, 5121
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
COMPONENTS = {"float32": FLOAT, "uint32": UINT32, "uint16": UINT16, "uint8": UINT8}


def png(pixels):
    """An 8-bit picture, (height, width, 1 to 4 channels), as PNG."""
    height, width, channels = pixels.shape
    rows = np.zeros((height, 1 + width * channels), dtype=np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 2: 4, 3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) +
            chunk(b"IEND", b""))


class Glb:
    """A glTF document under construction; every method returns the index of what it adds."""

    def __init__(self):
        self.binary = bytearray()
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}

    def add(self, where, value):
        self.document.setdefault(where, []).append(value)
        return len(self.document[where]) - 1

    def extension(self, name, value):
        """What a material or node says by an extension."""
        used = self.document.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)
        return {"extensions": {name: value}}

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.binary += data
        where = {"buffer": 0, "byteOffset": len(self.binary) - len(data), "byteLength": len(data)}
        return self.add("bufferViews", where)

    def accessor(self, array, normalized=False):
        array = np.ascontiguousarray(array)
        width = 1 if array.ndim == 1 else int(np.prod(array.shape[1:]))
        accessor = {"bufferView": self.view(array.tobytes()), "componentType": COMPONENTS[array.dtype.name],
                    "count": len(array), "type": KINDS[width]}
        if normalized:
            accessor["normalized"] = True
        if array.dtype == np.float32 and width == 3:
            accessor.update(min=array.min(axis=0).tolist(), max=array.max(axis=0).tolist())
        return self.add("accessors", accessor)

    def texture(self, pixels):
        image = self.add("images", {"bufferView": self.view(png(pixels)), "mimeType": "image/png"})
        return {"index": self.add("textures", {"source": image})}

    def light(self, kind, **values):
        lights = self.document.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"type": kind, **values})
        return self.extension("KHR_lights_punctual", {"light": len(lights) - 1})

    def node(self, root=True, **values):
        index = self.add("nodes", values)
        if root:
            self.document["scenes"][0]["nodes"].append(index)
        return index

    def primitive(self, shape, material=None, **more):
        """shape: {"indices": ..., attribute: array}."""
        made = {"attributes": {name: self.accessor(array, normalized=name == "COLOR_0" and array.dtype != np.float32)
                               for name, array in shape.items() if name != "indices"},
                "indices": self.accessor(shape["indices"]), **more}
        return made if material is None else {**made, "material": material}

    def write(self, path):
        self.document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        self.binary += b"\0" * (-len(self.binary) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(self.binary)))
            file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            file.write(struct.pack("<II", len(self.binary), 0x004E4942) + self.binary)
        return path


# --- Shapes -----------------------------------------------------------------------------------------------------------

def patch(columns, rows=None, x=(-1.0, 1.0), y=(-1.0, 1.0), z=0.0, waves=0.1):
    """A wavy sheet that faces +Z: 2 * columns * rows triangles."""
    rows = rows or columns
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    height = waves * np.sin(6 * np.pi * u) * np.cos(4 * np.pi * v)
    across = (x[1] - x[0], y[1] - y[0])
    slope_x = waves * 6 * np.pi * np.cos(6 * np.pi * u) * np.cos(4 * np.pi * v) / across[0]
    slope_y = -waves * 4 * np.pi * np.sin(6 * np.pi * u) * np.sin(4 * np.pi * v) / across[1]
    normal = np.stack([-slope_x, -slope_y, np.ones_like(u)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    above = corner + columns + 1
    squares = np.stack([corner, corner + 1, above + 1, corner, above + 1, above], axis=1)
    position = np.stack([x[0] + across[0] * u, y[0] + across[1] * v, z + height], axis=-1)
    return {"indices": squares.ravel().astype(np.uint32), "POSITION": position.reshape(-1, 3).astype(np.float32),
            "NORMAL": normal.reshape(-1, 3).astype(np.float32),
            "TEXCOORD_0": np.stack([u, 1 - v], axis=-1).reshape(-1, 2).astype(np.float32)}


def pattern(size, channels=3, seed=1):
    """Smooth colours with a grain: compresses neither to nothing nor not at all."""
    y, x = np.mgrid[0:size, 0:size].astype(np.float32) / size
    grain = np.random.default_rng(seed).integers(0, 8, (min(size, 64), min(size, 64), channels), dtype=np.uint8)
    grain = np.tile(grain, (-(-size // grain.shape[0]), -(-size // grain.shape[1]), 1))[:size, :size]
    waves = [127 + 100 * np.sin(6.28 * ((c + 1) * x + (seed + c) % 3 * y)) for c in range(channels)]
    return np.stack(waves, axis=-1).astype(np.uint8) + grain


def normal_map(size):
    y, x = np.mgrid[0:size, 0:size].astype(np.float32) * (6.28 * 8 / size)
    return np.stack([127 + 30 * np.sin(x), 127 + 30 * np.cos(y), 240 + 0 * x], axis=-1).astype(np.uint8)


# --- Scenes that grow -------------------------------------------------------------------------------------------------

def one_mesh(glb, primitive, **node):
    glb.node(mesh=glb.add("meshes", {"primitives": [primitive]}), **node)
    return glb


def triangles(count):
    side = max(1, round((count / 2) ** 0.5))
    glb = Glb()
    return one_mesh(glb, glb.primitive(patch(side), glb.add("materials", {})))


def textured(size):
    """One sheet with a base colour texture of size x size."""
    glb = Glb()
    material = glb.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": glb.texture(pattern(size))}})
    return one_mesh(glb, glb.primitive(patch(32), material))


def lit_by(count, reach=None):
    """A sheet under `count` point lights on a lattice before it. reach: their range; None: as far as they shine."""
    glb = one_mesh(Glb(), None)
    glb.document["meshes"][0]["primitives"] = [glb.primitive(patch(32), glb.add("materials", {}))]
    side = int(np.ceil(count ** 0.5))
    for i in range(count):
        place = [-0.9 + 1.8 * (i % side + 0.5) / side, -0.9 + 1.8 * (i // side + 0.5) / side, 0.3]
        glb.node(translation=place, **glb.light("point", intensity=2.0 / count, **({"range": reach} if reach else {})))
    return glb


def layers(count, alpha_mode="OPAQUE", back_to_front=True):
    """Sheets behind one another, the farthest drawn first: the worst order for a depth buffer."""
    glb = Glb()
    material = glb.add("materials", {"alphaMode": alpha_mode,
                                     "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.5, 0.3, 0.3]}})
    for i in range(count):
        z = 0.01 * (i if back_to_front else count - i)
        one_mesh(glb, glb.primitive(patch(8, waves=0.0, z=z), material))
    return glb


def morphed(count):
    glb, shape = Glb(), patch(64)
    primitive = glb.primitive(shape, glb.add("materials", {}))
    if count:
        moved = np.zeros_like(shape["POSITION"])
        moved[:, 2] = 0.05 * shape["POSITION"][:, 0]
        place = glb.accessor(moved)
        primitive["targets"] = [{"POSITION": place} for _ in range(count)]
    glb.add("meshes", {"primitives": [primitive], **({"weights": [1.0 / count] * count} if count else {})})
    glb.node(mesh=0)
    return glb


def skinned(joints):
    glb, shape = Glb(), patch(64)
    n = len(shape["POSITION"])
    if joints:
        first = (np.arange(n) % joints).astype(np.uint16)
        shape["JOINTS_0"] = np.stack([first, (first + 1) % joints, first * 0, first * 0], axis=-1)
        shape["WEIGHTS_0"] = np.tile(np.float32([0.5, 0.5, 0, 0]), (n, 1))
    glb.add("meshes", {"primitives": [glb.primitive(shape, glb.add("materials", {}))]})
    if joints:
        bones = [glb.node(translation=[0, 0, 0.001 * i]) for i in range(joints)]
        inverse = glb.accessor(np.tile(np.eye(4, dtype=np.float32).reshape(1, 16), (joints, 1)))
        glb.add("skins", {"joints": bones, "inverseBindMatrices": inverse})
    glb.node(mesh=0, **({"skin": 0} if joints else {}))
    return glb


# --- All features, less some ------------------------------------------------------------------------------------------

def everything_but(*without):
    """One sheet for each way to be drawn. `without` names what is left out, see feature_cost.py."""
    glb, has = Glb(), lambda feature: feature not in without
    kind = {} if has("lighting") else glb.extension("KHR_materials_unlit", {})
    model, material = {"metallicFactor": 0.6, "roughnessFactor": 0.5}, {"doubleSided": True, **kind}
    if has("base colour texture"):
        model["baseColorTexture"] = glb.texture(pattern(256, 4))
    if has("metallic-roughness texture"):
        model["metallicRoughnessTexture"] = glb.texture(pattern(256, seed=2))
    if has("normal texture"):
        material["normalTexture"] = glb.texture(normal_map(256))
    if has("occlusion texture"):
        material["occlusionTexture"] = glb.texture(pattern(256, seed=3))
    if has("emission"):
        material["emissiveFactor"] = [0.5, 0.5, 0.5]
        if has("emissive texture"):
            material["emissiveTexture"] = glb.texture(pattern(256, seed=4))
    rich = glb.add("materials", {**material, "pbrMetallicRoughness": model})
    plain = glb.add("materials", {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.6, 0.4, 0.5]}, **kind})

    # Extensions stand on a material of their own: with none of them it has the kernel of core glTF.
    extensions = {
        "clear coat": ("clearcoat", {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.1}),
        "sheen": ("sheen", {"sheenColorFactor": [0.3, 0.2, 0.1], "sheenRoughnessFactor": 0.4}),
        "specular factors": ("specular", {"specularFactor": 0.7, "specularColorFactor": [1, 0.8, 0.6]}),
        "index of refraction": ("ior", {"ior": 1.4}),
        "transmission": ("transmission", {"transmissionFactor": 0.4}),
        "volume": ("volume", {"thicknessFactor": 0.1, "attenuationDistance": 0.5, "attenuationColor": [0.8, 0.9, 1]}),
        "dispersion": ("dispersion", {"dispersion": 2.0}),
        "diffuse transmission": ("diffuse_transmission", {"diffuseTransmissionFactor": 0.3}),
        "iridescence": ("iridescence", {"iridescenceFactor": 0.6}),
        "anisotropy": ("anisotropy", {"anisotropyStrength": 0.5}),
    }
    stated = {} if not has("lighting") or not has("material extensions") else {
        f"KHR_materials_{name}": values for feature, (name, values) in extensions.items() if has(feature)}
    for name in stated:
        glb.extension(name, {})
    layered = glb.add("materials", {"extensions": stated or kind.get("extensions", {}), "pbrMetallicRoughness": {
        "metallicFactor": 0.2, "roughnessFactor": 0.4}})

    def place(column, shape_material, row=0, z=0.0, color=False, **mesh):
        shape = patch(16, x=(2.2 * column - 1, 2.2 * column + 1), y=(2.2 * row - 1, 2.2 * row + 1), z=z)
        if color:
            shape["COLOR_0"] = (0.5 + 0.5 * np.sin(7 * shape["POSITION"] + [0, 1, 2])).astype(np.float32)
        made = glb.primitive(shape, shape_material, **mesh)
        glb.add("meshes", {"primitives": [made]})
        return len(glb.document["meshes"]) - 1, made, len(shape["POSITION"])

    glb.node(mesh=place(-1, rich)[0])
    glb.node(mesh=place(0, plain, color=has("vertex colours"))[0])
    glb.node(mesh=place(1, layered, row=1)[0])
    if has("alpha test"):
        glb.node(mesh=place(1, glb.add("materials", {"alphaMode": "MASK", "pbrMetallicRoughness": model, **kind}))[0])
    if has("blending"):
        see_through = glb.add("materials", {"alphaMode": "BLEND", **kind, "pbrMetallicRoughness": {
            "baseColorFactor": [0.2, 0.6, 0.9, 0.4]}})
        glb.node(mesh=place(0, see_through, z=0.5)[0])
    index, made, n = place(-1, plain, row=1)
    if has("morph targets"):
        made["targets"] = [{"POSITION": glb.accessor(np.full((n, 3), 0.1, np.float32))} for _ in range(2)]
        glb.document["meshes"][index]["weights"] = [0.3, 0.4]
    glb.node(mesh=index)
    index, made, n = place(0, plain, row=1)
    if has("skinning"):
        made["attributes"]["JOINTS_0"] = glb.accessor(np.tile(np.uint8([0, 1, 0, 0]), (n, 1)))
        made["attributes"]["WEIGHTS_0"] = glb.accessor(np.tile(np.float32([0.5, 0.5, 0, 0]), (n, 1)))
        bones = [glb.node(translation=[0, 0.1 * i, 0]) for i in range(2)]
        glb.add("skins", {"joints": bones})
    glb.node(mesh=index, **({"skin": 0} if has("skinning") else {}))
    if has("punctual lights"):
        if has("directional lights"):
            glb.node(**glb.light("directional", intensity=1.0))
        glb.node(translation=[0, 1, 2], **glb.light("point", intensity=5.0))
        if has("spot lights"):
            glb.node(translation=[1, 0, 3], **glb.light("spot", intensity=9.0, spot={"outerConeAngle": 0.6}))
    return glb

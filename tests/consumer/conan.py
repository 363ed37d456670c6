# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
"""conan.py ISM_SOURCE SCRATCH COMPILER GENERATOR VERSION HINTS

Runs the recipe packaging/conan/conanfile.py through what `conan create` and `conan install` do with a recipe, by a small
stand-in of the modules it imports, as docs.conan.io/2 describes them: exported to a cache, where the source tree is gone, built,
packaged, and used by find_package. It shows that the recipe is right by the documentation; not that a certain Conan takes it.
"""
import fnmatch
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import types
from pathlib import Path

# Versions seen in Conan Center.
CENTER = {"nanoflann": ["1.5.2", "1.6.0"], "nlohmann_json": ["3.11.2", "3.11.3"], "stb": ["cci.20240213", "cci.20240531"]}


def fail(text):
    sys.exit("consumer by conan: " + text)


def expect(what, expected, got):
    if expected != got:
        fail(f"{what}: expected {expected}, got {got}")


# -- The modules that the recipe imports.
class ConanInvalidConfiguration(Exception):
    pass


class Setting:
    """A setting and those below it; one that is not there is an error, as in Conan."""

    def __init__(self, value, **below):
        self.value, self.below = value, below

    def __getattr__(self, name):
        if name in self.__dict__["below"]:
            return self.below[name]
        raise ConanInvalidConfiguration(f"'settings' has no '{name}'")

    def __eq__(self, other):
        return self.value == other

    def __hash__(self):
        return hash(self.value)

    def get_safe(self, name, default=None):
        setting = self
        for part in name.split("."):
            setting = setting.below.get(part)
            if setting is None:
                return default
        return setting.value


class CppInfo:
    def __init__(self):
        self.includedirs, self.libdirs, self.bindirs = ["include"], ["lib"], ["bin"]
        self.libs, self.system_libs, self.defines, self.frameworks = [], [], [], []
        self.properties = {}

    def set_property(self, name, value):
        known = ("cmake_file_name", "cmake_target_name", "pkg_config_name")
        if name not in known:
            fail(f"set_property: expected one of {known}, got {name}")
        self.properties[name] = value


class ConanFile:
    name = version = license = description = package_type = settings = None

    def __init__(self, recipe_folder):
        self.recipe_folder = str(recipe_folder)
        self.required = []

    def requires(self, reference):
        self.required.append(reference)


def copy(conanfile, pattern, src, dst, keep_path=True, excludes=None):
    """Files below src whose path matches the pattern (in which * matches / as well), to dst with their path."""
    copied = []
    for file in sorted(path for path in Path(src).rglob("*") if path.is_file()):
        name = file.relative_to(src).as_posix()
        if fnmatch.fnmatch(name, pattern) and not (excludes and fnmatch.fnmatch(name, excludes)):
            target = Path(dst) / (name if keep_path else file.name)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, target)
            copied.append(str(target))
    return copied


def check_min_cppstd(conanfile, cppstd):
    given = conanfile.settings.get_safe("compiler.cppstd")
    if given is None:
        raise ConanInvalidConfiguration("compiler.cppstd is not set")
    if int(str(given).replace("gnu", "")) < int(cppstd):
        raise ConanInvalidConfiguration(f"C++{given} is less than C++{cppstd}")


def module(name, **members):
    made = types.ModuleType(name)
    made.__dict__.update(members)
    made.__path__ = []
    sys.modules[name] = made


module("conan", ConanFile=ConanFile)
module("conan.errors", ConanInvalidConfiguration=ConanInvalidConfiguration)
module("conan.tools")
module("conan.tools.build", check_min_cppstd=check_min_cppstd)
module("conan.tools.files", copy=copy, load=lambda conanfile, path: Path(path).read_text(encoding="utf-8"))


def load_recipe(folder):
    spec = importlib.util.spec_from_file_location("recipe", folder / "conanfile.py")
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    recipes = [value for value in vars(loaded).values()
               if isinstance(value, type) and issubclass(value, ConanFile) and value is not ConanFile]
    expect("conanfile.py: recipes", 1, len(recipes))
    return recipes[0](folder)


def settings(cppstd):
    compiler = Setting("gcc", version=Setting("12"), libcxx=Setting("libstdc++11"), cppstd=Setting(cppstd))
    return Setting("", os=Setting("Linux"), arch=Setting("x86_64"), build_type=Setting("Release"), compiler=compiler)


# -- What Conan does with a recipe.
def export(source, cache):
    """`conan export`: beside the source tree, into the cache."""
    recipe = load_recipe(source / "packaging" / "conan")
    os.chdir(recipe.recipe_folder)
    recipe.set_version()
    recipe.export_sources_folder = str(cache / "export_source")
    recipe.export_sources()
    (cache / "export").mkdir(parents=True)
    shutil.copy2(Path(recipe.recipe_folder) / "conanfile.py", cache / "export")
    return recipe.version


def create(cache, version):
    """From the cache alone: requirements, build, package."""
    recipe = load_recipe(cache / "export")
    recipe.version = version
    os.chdir(cache)
    recipe.settings = settings("17")
    try:
        recipe.validate()
        fail("validate: expected C++17 to be refused, got no error")
    except ConanInvalidConfiguration:
        pass
    recipe.settings = settings("20")
    recipe.requirements()
    recipe.validate()
    recipe.info = types.SimpleNamespace(cleared=False)
    recipe.info.clear = lambda: setattr(recipe.info, "cleared", True)
    recipe.package_id()
    expect("package_id: one package for all settings", True, recipe.info.cleared)
    for step in ("layout", "source", "generate", "build"):
        if hasattr(recipe, step):
            fail(f"conanfile.py: a {step}() is not run by this stand-in: teach it")
    expect("conanfile.py: no_copy_source", True, recipe.no_copy_source)
    recipe.source_folder = str(cache / "export_source")
    recipe.package_folder = str(cache / "package")
    recipe.package()
    recipe.cpp_info = CppInfo()
    recipe.package_info()
    return recipe


def check_package(recipe, source):
    expect("conanfile.py", ("ism", "MIT", "header-library"), (recipe.name, recipe.license, recipe.package_type))
    package = Path(recipe.package_folder)
    files = {path.relative_to(package).as_posix() for path in package.rglob("*") if path.is_file()}
    headers = {path.relative_to(source).as_posix() for path in (source / "include").rglob("*.hpp")}
    expected = headers | {"licenses/LICENSE"}
    if files != expected:
        fail("the package: expected all headers and licenses/LICENSE alone; "
             f"missing {sorted(expected - files)[:5]}, stray {sorted(files - expected)[:5]}")
    expect("licenses/LICENSE", (source / "LICENSE").read_text(), (package / "licenses/LICENSE").read_text())
    info = recipe.cpp_info
    for folder in info.includedirs + info.libdirs + info.bindirs:
        if not (package / folder).is_dir():
            fail(f"package_info: {folder}: expected a folder of the package, got none")


def install_requirements(recipe, hints, folder):
    """The packages it requires, as Conan Center lays them out: their include folders."""
    def find(name):
        for hint in [*hints, "/usr/include", "/usr/local/include"]:
            if hint and (Path(hint) / name).exists():
                return Path(hint) / name
        print(f"skipped: {name} is not installed")
        sys.exit(0)

    layouts = {"nanoflann": lambda to: shutil.copy2(find("nanoflann.hpp"), to),
               "nlohmann_json": lambda to: shutil.copytree(find("nlohmann"), to / "nlohmann"),
               "stb": lambda to: [shutil.copy2(header, to) for header in find("stb").glob("*.h")]}
    expect("requirements", sorted(layouts), sorted(reference.split("/")[0] for reference in recipe.required))
    includes = {}
    for reference in recipe.required:
        name, version = reference.split("/")
        if version not in CENTER[name]:
            fail(f"requirements: {name}: expected one of {CENTER[name]}, got {version}")
        includes[name] = folder / name / "include"
        includes[name].mkdir(parents=True)
        layouts[name](includes[name])
    return includes


def generate(recipe, includes, folder):
    """What CMakeDeps makes for `find_package`."""
    folder.mkdir()
    info = recipe.cpp_info
    name, target = info.properties["cmake_file_name"], info.properties["cmake_target_name"]
    lines = []
    for package, include in includes.items():
        lines += [f"add_library({package}::{package} INTERFACE IMPORTED)",
                  f"target_include_directories({package}::{package} INTERFACE \"{include}\")"]
    folders = " ".join(f'"{recipe.package_folder}/{path}"' for path in info.includedirs)
    linked = " ".join([f"{package}::{package}" for package in includes] + info.system_libs)
    lines += [f"add_library({target} INTERFACE IMPORTED)", f"target_include_directories({target} INTERFACE {folders})",
              f"target_link_libraries({target} INTERFACE {linked})"]
    (folder / f"{name}-config.cmake").write_text("\n".join(lines) + "\n")
    (folder / f"{name}-config-version.cmake").write_text(
        f'set(PACKAGE_VERSION "{recipe.version}")\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n')


def run(what, *command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        fail(f"{what} failed\n" + re.sub(r"(?m)^\.+ .*\n", "", done.stdout))
    return done.stdout


def main(source, scratch, compiler, generator, version, hints):
    source, scratch = Path(source), Path(scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    cache = scratch / "cache"
    expect("set_version", version, export(source, cache))
    recipe = create(cache, version)
    check_package(recipe, source)
    includes = install_requirements(recipe, hints.split(";"), scratch / "requirements")
    generate(recipe, includes, scratch / "generators")
    build = scratch / "build"
    run("configure a consumer", "cmake", "-S", source / "tests/consumer/recipe", "-B", build, "-G", generator,
        f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_PREFIX_PATH={scratch / 'generators'}", "-DCMAKE_CXX_STANDARD=20",
        f"-DISM_VERSION={version}")
    read = run("build a consumer", "cmake", "--build", build)
    for header in ("package/include/ism/io/images.hpp", "nanoflann/include/nanoflann.hpp", "include/nlohmann/json.hpp",
                   "stb/include/stb_image.h"):
        if f"/{header}\n" not in read:
            fail(f"build a consumer: expected {header} to be read, got another or none")
    others = re.findall(rf"\.+ (/usr/.*/(?:nanoflann|nlohmann|stb)\S*|{re.escape(str(source))}/include/\S*)", read)
    expect("build a consumer: headers that are not of a package", [], others)
    expect("run a consumer", f"ism {version}", run("run a consumer", build / "consumer").strip())
    print(f"conan's recipe: ism {version} with {', '.join(recipe.required)}")


if __name__ == "__main__":
    if len(sys.argv) != 7:
        sys.exit(__doc__)
    main(*sys.argv[1:])

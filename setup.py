"""pip install --no-index --no-build-isolation . — by the same CMake as everything else.

The build's folder is build/release, or KURBEL_BUILD; what is built there already is not built again. The version is
that of CMakeLists.txt.
"""

import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

here = os.path.dirname(os.path.abspath(__file__))


class Build(build_py):
    def run(self):
        build = os.environ.get("KURBEL_BUILD", os.path.join(here, "build", "release"))
        ninja = os.path.join(build, "build.ninja")
        if not os.path.exists(ninja):
            subprocess.check_call(["cmake", "-S", here, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"])
        elif "kurbel_python" not in pathlib.Path(ninja).read_text(encoding="utf-8"):
            # Configured before there was pybind11, as for the program alone.
            subprocess.check_call(["cmake", build])
        subprocess.check_call(["cmake", "--build", build, "--target", "kurbel_python"])
        shutil.copytree(os.path.join(build, "python", "kurbel"), os.path.join(self.build_lib, "kurbel"),
                        dirs_exist_ok=True)


class Binary(Distribution):
    def has_ext_modules(self):
        return True


def version():
    with open(os.path.join(here, "CMakeLists.txt"), encoding="utf-8") as lists:
        return re.search(r"project\(kurbel VERSION ([0-9.]+)", lists.read())[1]


# What setuptools leaves behind goes into the build's folder, too.
left = os.path.join(here, "build", "pip")
os.makedirs(left, exist_ok=True)
setup(version=version(), packages=["kurbel"], package_dir={"kurbel": "python/kurbel"}, cmdclass={"build_py": Build}, distclass=Binary,
      options={"egg_info": {"egg_base": left}, "build": {"build_base": left}})

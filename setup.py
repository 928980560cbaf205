"""What pyproject.toml cannot say: the compiled extension goes along where the launcher or CMake has built it."""

import sysconfig
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

# Of this version of Python; empty where there is none.
extension = list(Path("build/release/cases/python/extension").glob("_pfdm" + sysconfig.get_config_var("EXT_SUFFIX")))


class BuildWithExtension(build_py):
    def run(self):
        super().run()
        stub = [Path("cases/python/_pfdm.pyi")] if extension else []
        for file in [*extension, *stub]:
            self.copy_file(file, Path(self.build_lib) / file.name)


class WithExtension(Distribution):
    """A wheel for this machine alone, if it has the extension."""

    def has_ext_modules(self):
        return bool(extension)


setup(cmdclass={"build_py": BuildWithExtension}, distclass=WithExtension)

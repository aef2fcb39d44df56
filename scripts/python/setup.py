"""Builds the package `jostle`: Python alone, and the declarations of the C library, read from its headers.

    python3 setup.py build            # offline, from Debian's python3-cffi, python3-numpy, python3-setuptools
"""
from pathlib import Path

from setuptools import setup

setup(
    name="jostle",
    version="0.1.0",
    description="Dense crowds that push, scripted in Lua",
    long_description=(Path(__file__).resolve().parent / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license="MIT",
    packages=["jostle"],
    package_data={"jostle": ["py.typed"]},
    python_requires=">=3.9",
    install_requires=["cffi", "numpy"],
    setup_requires=["cffi"],
    cffi_modules=["declarations.py:ffi"],
)

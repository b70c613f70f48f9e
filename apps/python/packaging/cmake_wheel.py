"""`pip install .`: a PEP 517 backend that has CMake build the module and puts it into a wheel. Standard library only, so that
`pip install --no-index --no-build-isolation .` needs nothing but what hookpoint itself is built with (docs/decisions/0026).

Settings (pip's --config-settings NAME=VALUE):
  build-dir   folder of the build, taken as it is configured where it has been (default: build/wheel, as the preset release)
  jobs        how many compilers at once (default: as many as Ninja likes)
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[3]
STUBS = "hookpoint-stubs/__init__.pyi"


def version():
    return re.search(r"project\(hookpoint VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


def get_requires_for_build_wheel(config_settings=None):
    return []


def _build(settings):
    """Builds the module for the Python that runs this; its file."""
    folder = SOURCE / settings.get("build-dir", "build/wheel")
    if not (folder / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "--preset", "release", "-B", folder, "-DBUILD_TESTING=OFF", f"-DPython_EXECUTABLE={sys.executable}"],
                       cwd=SOURCE, check=True)
    jobs = ["--parallel", settings["jobs"]] if "jobs" in settings else []
    subprocess.run(["cmake", "--build", folder, "--target", "hookpoint_module", *jobs], check=True)
    module = folder / "python" / ("hookpoint" + sysconfig.get_config_var("EXT_SUFFIX"))
    if not module.exists():
        raise SystemExit(f"{folder} was configured for another Python than {sys.executable}: give another build-dir")
    return module


def _metadata():
    lines = ["Metadata-Version: 2.1", "Name: hookpoint", f"Version: {version()}",
             "Summary: Dynamics of legged robots under comparable contact models", "Requires-Python: >=3.9", "Requires-Dist: numpy"]
    return "\n".join(lines) + "\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = _build(config_settings or {})
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-" + re.sub(r"[-.]", "_", sysconfig.get_platform())
    info = f"hookpoint-{version()}.dist-info"
    files = {
        module.name: module.read_bytes(),
        STUBS: (SOURCE / "apps/python" / STUBS).read_bytes(),
        f"{info}/METADATA": _metadata().encode(),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: hookpoint\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(),
        f"{info}/LICENSE": (SOURCE / "LICENSE").read_bytes(),
    }
    record = []
    name = f"hookpoint-{version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(zipfile.ZipInfo(path), content, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(content)}")
        record.append(f"{info}/RECORD,,")
        wheel.writestr(zipfile.ZipInfo(f"{info}/RECORD"), "\n".join(record) + "\n")
    return name

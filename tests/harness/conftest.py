from pathlib import Path

import pytest
from real_reports import Report, written_reports


@pytest.fixture(scope="session")
def reports(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Report]:
    """One of each kind."""
    return written_reports(ratchet_fmu, tmp_path_factory.mktemp("reports"))

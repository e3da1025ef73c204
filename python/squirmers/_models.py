"""Models by their names."""

from __future__ import annotations

from ._native import Model, Scene, family_model

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

_named: dict[tuple[str, int | None, bool], Model] = {}


def _known(name: str, level: int | None, direct: bool) -> Model:
    """A model that keeps its tables for the next call."""
    key = (name, level, direct)
    known = _named.get(key)
    if known is None:
        known = _named.setdefault(key, Model(name, level=level, direct=direct))
    return known


def as_model(model: str | Model) -> Model:
    """The model itself, or the one of this name."""
    if isinstance(model, Model):
        return model
    if not isinstance(model, str):
        raise TypeError(f"a model is a Model or a name, not {type(model).__name__}")
    return _known(model, None, False)


def as_models(models: str | Model | Iterable[str | Model]) -> list[Model]:
    """One model or several, as a list."""
    if isinstance(models, (str, Model)):
        return [as_model(models)]
    return [as_model(model) for model in models]


def model_of(scene: Scene, model: str | Model | None) -> Model:
    """The model that is given, or else the scene's own, or else the exact one."""
    if not isinstance(scene, Scene):
        raise TypeError(f"a scene is a Scene, not {type(scene).__name__}")
    return _known(*scene._model()) if model is None else as_model(model)


def models_of_family(
    family: str | os.PathLike[str], models: str | Model | Iterable[str | Model] | None
) -> list[Model]:
    """The models that are given, or else the one that a family names, or else lubrication theory and the exact one."""
    own = family_model(family) if models is None else None
    if own is not None:
        return [_known(*own)]
    return as_models(("lt", "exact") if models is None else models)

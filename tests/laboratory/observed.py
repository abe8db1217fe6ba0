"""What a diagnosis states beyond its names: probabilities, separability, parameters, errors."""

import numpy as np


def ranking(diagnosis):
    """Names of the whole catalogue, the likeliest first; evidence decides between equals."""

    def weight(candidate):
        number = (candidate.get("probability"), candidate.get("evidence"))
        return tuple(float("-inf") if x is None else x for x in number)

    candidates = diagnosis.get("candidates") or []
    return [c["name"] for c in sorted(candidates, key=weight, reverse=True)]


def noise_held_out(truth, diagnosis):
    """Rms of the noise that was really added to the samples which the finder held out.

    What the best model would leave there. That of all samples where either side does not tell.
    """
    heard = truth.get("heard") or []
    told = [record.get("held_out") for record in diagnosis.get("records") or []]
    if len(heard) != len(told) or not any(told):
        return truth["noise"]["realised_rms"]
    parts = []
    for (time, error), stretches in zip(heard, told, strict=True):
        near = 0.25 * (time[-1] - time[0]) / len(time)  # files are written with few digits
        for first, last in stretches or []:
            parts.append(error[(time >= first - near) & (time <= last + near)])
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def observe(truth, diagnosis):
    """Plain values to be kept with the marks of a case; nothing here is judged."""
    candidates = {c["name"]: c for c in diagnosis.get("candidates") or []}
    order = ranking(diagnosis)
    hidden = truth.get("effects") or [truth["effect"]]
    fitted = {s["name"]: s["fitted"] for s in diagnosis.get("separability") or []}
    realised, unseen = truth["noise"]["realised_rms"], noise_held_out(truth, diagnosis)
    same = diagnosis.get("judged") == ("displacement" if truth["drive"] == "force" else "force")
    after = (diagnosis.get("extended") or {}).get("held_out_rms")
    before = (diagnosis.get("baseline") or {}).get("held_out_rms")
    return {
        "ranks": {name: order.index(name) + 1 for name in hidden if name in order},
        "probabilities": {name: c.get("probability") for name, c in candidates.items()},
        "lambda_sep": {name: candidates.get(name, {}).get("lambda_sep") for name in hidden},
        "lambda_of_its_size": {name: fitted.get(name, False) for name in hidden},
        "found": {
            cause["name"]: {p["name"]: [p["value"], p["interval"]] for p in cause["parameters"]}
            for cause in diagnosis.get("causes") or []
        },
        "rivals": {
            cause["name"]: cause.get("ambiguous_with") or []
            for cause in diagnosis.get("causes") or []
        },
        # Comparable with the noise only where the finder judges the channel that carries it.
        "held_out_over_noise": after / unseen if same and after is not None else None,
        "baseline_over_noise": before / unseen if same and before is not None else None,
        "noise_stated_over_true": (diagnosis.get("noise") or {}).get("rms", 0.0) / realised
        if same
        else None,
    }


def hidden_of(truth):
    """What the truth says of a case that later questions need."""
    return {
        "parameters": truth["parameters"],
        "peak": truth["peak"],
        "drive": truth["drive"],
        "load": [f["kind"] for f in truth["files"]],
        "noise": truth["noise"]["kind"],
        "coloured": truth["noise"]["lag_one_correlation"] > 0.0,
        "law": truth["joint"]["law"],
        "beginning": truth.get("beginning", {}).get("way"),
    }
